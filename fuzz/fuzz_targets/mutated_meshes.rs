#![no_main]
use orthoball::attack::MutatedMeshCase;

libfuzzer_sys::fuzz_target!(|case: MutatedMeshCase| case.run());
