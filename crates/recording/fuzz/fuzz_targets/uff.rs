#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::file::uff::Uff;
use std::io::Cursor;

fuzz_target!(|data: &[u8]| {
    touch::touch(Uff::from_source(Cursor::new(data.to_vec()), "fuzz.uff".as_ref()));
});
