#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::file::hdf5::Hdf5;
use std::io::Cursor;

fuzz_target!(|data: &[u8]| {
    touch::touch(Hdf5::from_source(Cursor::new(data.to_vec()), "fuzz.h5".as_ref()));
});
