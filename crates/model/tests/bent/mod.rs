//! Rotors that bend, by what must close. Beside an independent implementation they are judged by `auxbear validate`.

pub mod housings;
mod ledger;
mod mirror;
mod one_node;
mod traps;
mod unbalances;
mod whirl;
