#![no_main]
use orthoball::attack::GcdrCase;

libfuzzer_sys::fuzz_target!(|case: GcdrCase| case.run());
