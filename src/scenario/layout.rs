//! How JSON is laid out: a scenario file for people, with a line per field and per cable; messages on one line.

use std::io;

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::Formatter;

/// `value` as JSON on one line.
pub(super) fn compact(value: &impl Serialize) -> String {
    let mut text = Vec::new();
    let _ = value.serialize(&mut Serializer::with_formatter(&mut text, Compact));
    String::from_utf8(text).unwrap_or_default()
}

/// Writes numbers as messages to people have them: the tables of a second way would take 10 kB of the worker.
struct Compact;

impl Formatter for Compact {
    fn write_f64<W: ?Sized + io::Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        write!(writer, "{value:?}")
    }
}

/// `value` as JSON: the outermost object and the lists in it line by line, everything deeper on one line.
pub(super) fn pretty(value: &impl Serialize) -> String {
    let mut text = Vec::new();
    let mut serializer = Serializer::with_formatter(&mut text, Layout { open: Vec::new() });
    // Writing to memory does not fail, and serde_json writes UTF-8.
    let _ = value.serialize(&mut serializer);
    String::from_utf8(text).unwrap_or_default()
}

/// For every open list or object, whether it has a line per item.
struct Layout {
    open: Vec<bool>,
}

impl Layout {
    fn begin<W: ?Sized + io::Write>(&mut self, writer: &mut W, bracket: &[u8], by_line: bool) -> io::Result<()> {
        self.open.push(by_line);
        writer.write_all(bracket)
    }

    fn item<W: ?Sized + io::Write>(&self, writer: &mut W, first: bool, before_first: &[u8]) -> io::Result<()> {
        let by_line = self.open.last() == Some(&true);
        writer.write_all(match (first, by_line) {
            (true, false) => before_first,
            (false, false) => b", ",
            (true, true) => b"\n",
            (false, true) => b",\n",
        })?;
        if by_line { writer.write_all(&b"  ".repeat(self.open.len())) } else { Ok(()) }
    }

    fn end<W: ?Sized + io::Write>(&mut self, writer: &mut W, after_last: &[u8], bracket: &[u8]) -> io::Result<()> {
        if self.open.pop() == Some(true) {
            writer.write_all(b"\n")?;
            writer.write_all(&b"  ".repeat(self.open.len()))?;
        } else {
            writer.write_all(after_last)?;
        }
        writer.write_all(bracket)
    }
}

impl Formatter for Layout {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, b"[", self.open.len() == 1)
    }

    fn begin_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.item(writer, first, b"")
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"", b"]")
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, b"{", self.open.is_empty())
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.item(writer, first, b" ")
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b" ", b"}")
    }
}
