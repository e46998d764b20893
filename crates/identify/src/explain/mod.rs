//! Which explanation of a torque transient the data support, and which test would decide.
