#![no_main]

use libfuzzer_sys::fuzz_target;
use recording::file::parquet::{self, Parquet};
use std::io::Cursor;
use std::sync::Once;

/// The library that unpacks Parquet panics on some damaged pages; the reader catches that. What it does not catch
/// still ends the run.
static HOOK: Once = Once::new();

fuzz_target!(|data: &[u8]| {
    HOOK.call_once(|| {
        std::panic::set_hook(Box::new(|info| {
            if !parquet::panic_is_caught() {
                eprintln!("{info}");
                std::process::abort();
            }
        }));
    });
    touch::touch(Parquet::from_source(Cursor::new(data.to_vec()), "fuzz.parquet".as_ref()));
});
