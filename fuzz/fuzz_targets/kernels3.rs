#![no_main]
use orthoball::attack::KernelCase3;

libfuzzer_sys::fuzz_target!(|case: KernelCase3| case.run());
