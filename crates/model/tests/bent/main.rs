//! Rotors that bend, beside an independent implementation and by what must close.

#[path = "../machines/mod.rs"]
#[allow(dead_code)] // shared with the other tests
mod machines;

mod drop;
mod files;
mod ledger;
mod points;
mod runup;
