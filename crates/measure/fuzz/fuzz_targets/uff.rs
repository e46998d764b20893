#![no_main]

use libfuzzer_sys::fuzz_target;
use measure::file::uff::Uff;
use std::io::Cursor;

fuzz_target!(|data: Vec<u8>| {
    touch::touch(Uff::from_source(Cursor::new(data), "fuzz.uff".as_ref()));
});
