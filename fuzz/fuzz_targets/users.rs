#![no_main]
use orthoball::attack::UserCase;

libfuzzer_sys::fuzz_target!(|case: UserCase| case.run());
