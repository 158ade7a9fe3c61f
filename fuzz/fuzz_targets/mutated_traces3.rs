#![no_main]
use orthoball::attack::MutatedTrace3Case;

libfuzzer_sys::fuzz_target!(|case: MutatedTrace3Case| case.run());
