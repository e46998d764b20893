#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::file::tdms::Tdms;
use std::io::Cursor;

fuzz_target!(|data: &[u8]| {
    touch::touch(Tdms::from_source(Cursor::new(data.to_vec()), "fuzz.tdms".as_ref()));
});
