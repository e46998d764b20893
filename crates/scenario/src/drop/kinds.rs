//! What a drop may be, as words.

use problem::words;

words! {
    /// What becomes of the rotor's spin, as a word.
    pub enum SpinKind {
        /// Free.
        Free = "free",
        /// Braked.
        Braked = "braked",
        /// Held.
        Held = "held",
    }
}

words! {
    /// Direction of the unbalance in repeated runs, as a word.
    pub enum UnbalanceAngle {
        /// As given.
        AsGiven = "as given",
        /// Random.
        Random = "random",
    }
}
