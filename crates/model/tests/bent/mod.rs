//! Rotors that bend, by what must close. Beside an independent implementation they are judged by `auxbear validate`.

mod ledger;
mod one_node;
mod traps;
