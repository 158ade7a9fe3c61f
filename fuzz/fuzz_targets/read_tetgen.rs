#![no_main]
use orthoball::attack::readers::{Target, run};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| run(Target::Tetgen, bytes));
