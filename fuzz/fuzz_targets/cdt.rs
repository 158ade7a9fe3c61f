#![no_main]
use orthoball::attack::CdtCase;

libfuzzer_sys::fuzz_target!(|case: CdtCase| case.run());
