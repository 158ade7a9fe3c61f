#![no_main]
use orthoball::attack::EditCase3;

libfuzzer_sys::fuzz_target!(|case: EditCase3| case.run());
