//! The program `orthoball`.

fn main() -> std::process::ExitCode {
    orthoball::cli::run(std::env::args_os())
}
