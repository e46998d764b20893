#![no_main]

use libfuzzer_sys::fuzz_target;
use measure::file::parquet::Parquet;
use std::io::Cursor;

fuzz_target!(|data: Vec<u8>| {
    touch::touch(Parquet::from_source(Cursor::new(data), "fuzz.parquet".as_ref()));
});
