#![no_main]

use libfuzzer_sys::fuzz_target;
use measure::file::tdms::Tdms;
use std::io::Cursor;

fuzz_target!(|data: Vec<u8>| {
    touch::touch(Tdms::from_source(Cursor::new(data), "fuzz.tdms".as_ref()));
});
