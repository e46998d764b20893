#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::file::csv::Csv;
use std::io::Cursor;

fuzz_target!(|data: &[u8]| {
    touch::touch(Csv::from_source(Cursor::new(data.to_vec()), "fuzz.csv".as_ref()));
});
