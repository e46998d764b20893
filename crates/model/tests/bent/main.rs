//! Rotors that bend, by what must close. Beside an independent implementation they are judged by `auxbear validate`.

#[path = "../machines/mod.rs"]
#[allow(dead_code)] // shared with the other tests
mod machines;

mod ledger;
