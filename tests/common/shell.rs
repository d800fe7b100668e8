//! The program as a shell sees it.

use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// How the program ended.
pub struct Done {
    /// Its exit code.
    pub code: Option<i32>,
    /// What it printed on standard output.
    pub out: String,
    /// And on standard error.
    pub err: String,
}

/// Runs `tautline` with `arguments` and `input` on standard input.
pub fn tautline(arguments: &[&str], input: &(impl AsRef<[u8]> + ?Sized)) -> Done {
    let mut process = Command::new(env!("CARGO_BIN_EXE_tautline"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The program may end without reading.
    let _ = process.stdin.take().unwrap().write_all(input.as_ref());
    let output = process.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Done { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

/// Runs it where all must go well and quietly; gives standard output.
pub fn succeed(arguments: &[&str], input: &(impl AsRef<[u8]> + ?Sized)) -> String {
    let Done { code, out, err } = tautline(arguments, input);
    assert_eq!((code, err.as_str()), (Some(0), ""), "{arguments:?}");
    out
}

/// Runs it where the input is bad; gives the lines on standard error.
pub fn refuse(arguments: &[&str], input: &(impl AsRef<[u8]> + ?Sized)) -> Vec<String> {
    let Done { code, out, err } = tautline(arguments, input);
    assert_eq!((code, out.as_str()), (Some(2), ""), "{arguments:?}: {err}");
    assert!(!err.is_empty() && err.ends_with('\n'), "{err:?}");
    err.lines().map(str::to_owned).collect()
}

/// A file for one test.
pub struct File(PathBuf);

impl File {
    pub fn new(name: &str, content: &[u8]) -> Self {
        let path = std::env::temp_dir().join(format!("tautline-{}-{name}", std::process::id()));
        fs::write(&path, content).unwrap();
        Self(path)
    }

    pub fn path(&self) -> &str {
        self.0.to_str().unwrap()
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}
