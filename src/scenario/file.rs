//! From a file to the text in it, whatever program has written the file.
//!
//! UTF-8 is read with and without a byte order mark, UTF-16 with one, as the shell and the editors of Windows write
//! them. What is refused says how it can be mended.

use std::fs;
use std::io::{self, Read};
use std::path::Path;

use thiserror::Error;

/// No scenario file is larger, in bytes: the largest robot needs some thousands. A film that is chosen by mistake is
/// refused before it is read.
pub const LARGEST: u64 = 1_000_000;
/// At the beginning of a text it says in which encoding it is; some editors write it in front of UTF-8 as well.
const MARK: char = '\u{feff}';

/// Why there is no text; continues a sentence that begins with the file's name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FileError {
    /// The system does not give it.
    #[error("cannot be read: {0}")]
    NotRead(String),
    /// It has more than [`LARGEST`] bytes.
    #[error("is larger than 1 MB, which no scenario is")]
    TooLarge,
    /// A byte that cannot stand there in UTF-8, with its position and line, both counted from 1.
    #[error("is not UTF-8: the byte 0x{byte:02X} at position {position}, in line {line}; save it as UTF-8")]
    NotUtf8 {
        /// The first byte that is wrong.
        byte: u8,
        /// How many bytes there are up to it.
        position: usize,
        /// How many lines.
        line: usize,
    },
    /// Nothing says which of the two bytes comes first.
    #[error("is UTF-16 without a byte order mark; save it as UTF-8")]
    Utf16Unmarked,
    /// An odd number of bytes.
    #[error("is UTF-16 that ends in the middle of a character; save it again, as UTF-8")]
    Utf16Cut,
    /// Half of a surrogate pair alone.
    #[error("is UTF-16 and has a character that is not whole; save it again, as UTF-8")]
    Utf16Broken,
    /// Four bytes a character.
    #[error("is UTF-32; save it as UTF-8")]
    Utf32,
    /// A picture, an archive, a program.
    #[error("is not a text")]
    NotText,
}

impl From<io::Error> for FileError {
    fn from(error: io::Error) -> Self {
        Self::NotRead(error.to_string())
    }
}

/// The text in the file at `path`. Its size is asked before anything is read.
///
/// # Errors
/// A file that cannot be read, is larger than [`LARGEST`], or is not a text in an encoding of [`decode`].
pub fn open(path: &Path) -> Result<String, FileError> {
    check_size(fs::metadata(path)?.len())?;
    read(&mut fs::File::open(path)?)
}

/// The text that comes from `source`. No more than [`LARGEST`] bytes and one are read, since pipes do not tell how much
/// they have.
///
/// # Errors
/// As for [`open`].
pub fn read(source: &mut dyn Read) -> Result<String, FileError> {
    let mut bytes = Vec::new();
    source.take(LARGEST + 1).read_to_end(&mut bytes)?;
    check_size(bytes.len() as u64)?;
    decode(&bytes)
}

/// Whether a scenario file may have this number of bytes.
///
/// # Errors
/// [`FileError::TooLarge`].
pub fn check_size(bytes: u64) -> Result<(), FileError> {
    if bytes > LARGEST { Err(FileError::TooLarge) } else { Ok(()) }
}

/// The text that `bytes` are: UTF-8 with or without a byte order mark, or UTF-16 with one, which is taken off.
///
/// # Errors
/// Another encoding, named where it can be recognised, with what helps.
pub fn decode(bytes: &[u8]) -> Result<String, FileError> {
    match bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => return Err(FileError::Utf32),
        [0xff, 0xfe, units @ ..] => return utf16(units, u16::from_le_bytes),
        [0xfe, 0xff, units @ ..] => return utf16(units, u16::from_be_bytes),
        _ => {}
    }
    // A scenario and a link begin with ASCII characters, which wider encodings fill up with zeros.
    match bytes.first_chunk().map(|first: &[u8; 4]| first.map(|byte| byte == 0)) {
        Some([false, true, true, true] | [true, true, true, false]) => return Err(FileError::Utf32),
        Some([false, true, false, true] | [true, false, true, false]) => return Err(FileError::Utf16Unmarked),
        _ => {}
    }
    match str::from_utf8(bytes) {
        Ok(text) => Ok(without_mark(text).to_owned()),
        // In a text such bytes are tabs, line ends and form feeds, in whatever encoding.
        Err(_) if bytes.iter().any(|byte| matches!(byte, 0..=8 | 14..=31)) => Err(FileError::NotText),
        Err(error) => {
            let (before, rest) = bytes.split_at(error.valid_up_to());
            let line = before.split(|byte| *byte == b'\n').count();
            let byte = rest.first().copied().unwrap_or_default();
            Err(FileError::NotUtf8 { byte, position: before.len() + 1, line })
        }
    }
}

/// `text` without the byte order mark that it may begin with.
pub fn without_mark(text: &str) -> &str {
    text.trim_start_matches(MARK)
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, FileError> {
    let (pairs, []) = bytes.as_chunks() else { return Err(FileError::Utf16Cut) };
    let units: Vec<u16> = pairs.iter().map(|pair| unit(*pair)).collect();
    let text = String::from_utf16(&units).map_err(|_| FileError::Utf16Broken)?;
    Ok(without_mark(&text).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "{ \"name\": \"Größe 大 🤖\" }\r\n";

    fn utf16_of(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn utf_8_and_marked_utf_16_are_the_same_text() {
        let marked = format!("\u{feff}{TEXT}");
        assert_eq!(decode(TEXT.as_bytes()).as_deref(), Ok(TEXT));
        assert_eq!(decode(marked.as_bytes()).as_deref(), Ok(TEXT));
        assert_eq!(decode(&utf16_of(&marked, u16::to_le_bytes)).as_deref(), Ok(TEXT));
        assert_eq!(decode(&utf16_of(&marked, u16::to_be_bytes)).as_deref(), Ok(TEXT));
        // A mark alone, and nothing at all, are empty texts.
        for bytes in [&b""[..], b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"] {
            assert_eq!(decode(bytes).as_deref(), Ok(""));
        }
    }

    #[test]
    fn other_encodings_are_recognised() {
        assert_eq!(decode(&utf16_of(TEXT, u16::to_le_bytes)), Err(FileError::Utf16Unmarked));
        assert_eq!(decode(&utf16_of(TEXT, u16::to_be_bytes)), Err(FileError::Utf16Unmarked));
        assert_eq!(decode(b"\xff\xfe{"), Err(FileError::Utf16Cut));
        assert_eq!(decode(b"\xfe\xff\xdc\x00"), Err(FileError::Utf16Broken));
        for text in [TEXT, &format!("\u{feff}{TEXT}")] {
            for bytes in [u32::to_le_bytes, u32::to_be_bytes] {
                let wide: Vec<u8> = text.chars().flat_map(|c| bytes(c.into())).collect();
                assert_eq!(decode(&wide), Err(FileError::Utf32));
            }
        }
        let latin = b"{\n\"name\": \"Gr\xf6\xdfe\" }";
        assert_eq!(decode(latin), Err(FileError::NotUtf8 { byte: 0xf6, position: 14, line: 2 }));
        // Cut in the middle of a character.
        assert_eq!(decode(b"\xc3"), Err(FileError::NotUtf8 { byte: 0xc3, position: 1, line: 1 }));
        assert_eq!(decode(b"\x1f\x8b\x08\x00gzip"), Err(FileError::NotText));
    }

    #[test]
    fn sizes_are_limited() {
        let most = LARGEST.try_into().expect("fits");
        assert_eq!(read(&mut &vec![b' '; most][..]).map(|text| text.len()), Ok(most));
        assert_eq!(read(&mut &vec![b' '; most + 1][..]), Err(FileError::TooLarge));
        assert_eq!(read(&mut io::repeat(b' ')), Err(FileError::TooLarge));
    }
}
