#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::file::wav::Wav;
use std::io::Cursor;

fuzz_target!(|data: &[u8]| {
    touch::touch(Wav::from_source(Cursor::new(data.to_vec()), "fuzz.wav".as_ref()));
});
