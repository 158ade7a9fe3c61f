#![no_main]
use orthoball::attack::MutatedTraceCase;

libfuzzer_sys::fuzz_target!(|case: MutatedTraceCase| case.run());
