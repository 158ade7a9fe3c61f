#![no_main]
use orthoball::attack::KernelCase;

libfuzzer_sys::fuzz_target!(|case: KernelCase| case.run());
