#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::file::mat5::Mat5;
use std::io::Cursor;

fuzz_target!(|data: &[u8]| {
    touch::touch(Mat5::from_source(Cursor::new(data.to_vec()), "fuzz.mat".as_ref()));
});
