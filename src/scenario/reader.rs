//! Strict reading of JSON: every value is asked for by name and kind, and all faults are collected with their paths.
//!
//! A reading that fails notes a [`Fault`] and gives a placeholder, so that the rest can be read all the same; what
//! was read counts only where [`Document::check`] finds no faults. Values stay the text of the file until they are
//! asked for: numbers are read exactly, and faults quote what is written.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use crate::robot::{Fault, Faults};
use crate::scenario::file::without_mark;

/// Longer values are cut in messages, in characters.
const SHOWN: usize = 60;
/// Not JSON, but some programs write these words for numbers that are not finite.
const NOT_FINITE: [&str; 3] = ["-Infinity", "Infinity", "NaN"];

/// A JSON text and the faults found in it so far.
pub(super) struct Document {
    name: &'static str,
    text: String,
    /// Set where `text` is JSON only because words for numbers that are not finite were put in quotes.
    syntax: Option<Fault>,
    faults: RefCell<Vec<Fault>>,
    /// The texts of numbers and vectors by their paths.
    numbers: RefCell<HashMap<String, String>>,
}

impl Document {
    /// Checks the syntax of `text`; messages about the whole call it `name`.
    ///
    /// # Errors
    /// The first syntax error, with line and column.
    pub(super) fn new(name: &'static str, text: &str) -> Result<Self, Faults> {
        // Not every way in is a file: texts are pasted, and handed over by programs.
        let text = without_mark(text);
        let is_json = |text: &str| serde_json::from_str::<&RawValue>(text).map(|_| ());
        let syntax = is_json(text)
            .err()
            .map(|error| Fault::new(name, format_args!("text that is not JSON ({error})"), "one JSON object"));
        let text = match &syntax {
            None => text.to_owned(),
            Some(fault) => {
                let quoted = quote_not_finite(text);
                is_json(&quoted).map_err(|_| Faults::from(fault.clone()))?;
                quoted
            }
        };
        Ok(Self { name, text, syntax, faults: RefCell::default(), numbers: RefCell::default() })
    }

    /// The outermost value.
    pub(super) fn root(&self) -> Value<'_> {
        Value { document: self, path: String::new(), content: Content::Json(self.text.trim()) }
    }

    /// Whether all that was read is sound.
    ///
    /// # Errors
    /// All faults so far, in the order of reading.
    pub(super) fn check(&self) -> Result<(), Faults> {
        let mut faults = self.faults.borrow().clone();
        if faults.is_empty() {
            faults.extend(self.syntax.clone());
        }
        Faults::check(faults)
    }

    /// `faults` found later in numbers that were read, with the values as they are written in the file.
    pub(super) fn quoted(&self, mut faults: Faults) -> Faults {
        for fault in faults.list_mut() {
            if let Some(text) = self.numbers.borrow().get(&fault.path) {
                fault.value.clone_from(text);
            }
        }
        faults
    }
}

/// Puts [`NOT_FINITE`] words outside strings in quotes.
fn quote_not_finite(text: &str) -> String {
    let (mut quoted, mut rest, mut in_string) = (String::with_capacity(text.len()), text, false);
    while let Some(next) = rest.chars().next() {
        let word = NOT_FINITE.iter().find(|word| !in_string && rest.starts_with(**word));
        let length = match word {
            Some(word) => word.len(),
            None if next == '\\' => rest.chars().take(2).map(char::len_utf8).sum(),
            None => next.len_utf8(),
        };
        let (part, after) = rest.split_at(length);
        let quote = if word.is_some() { "\"" } else { "" };
        quoted.extend([quote, part, quote]);
        in_string ^= next == '"';
        rest = after;
    }
    quoted
}

/// What stands at a path.
#[derive(Clone, Copy)]
enum Content<'a> {
    /// This text.
    Json(&'a str),
    /// Nothing, which is a fault once it is asked for.
    Missing,
    /// Part of a value that is itself at fault: nothing more to say.
    Lost,
}

/// A place in the document, to be read as one kind of value.
pub(super) struct Value<'a> {
    document: &'a Document,
    path: String,
    content: Content<'a>,
}

impl<'a> Value<'a> {
    fn parse<T: Deserialize<'a>>(&self) -> Option<T> {
        match self.content {
            Content::Json(text) => serde_json::from_str(text).ok(),
            Content::Missing | Content::Lost => None,
        }
    }

    /// The JSON that stands here, whatever it is; empty where there is none.
    pub(super) fn json(&self) -> &'a str {
        match self.content {
            Content::Json(text) => text,
            Content::Missing | Content::Lost => "",
        }
    }

    /// Notes that only `allowed` may stand here.
    fn fault(&self, allowed: &str) {
        let value = match self.content {
            Content::Json(text) => shown(text),
            Content::Missing => Fault::MISSING.into(),
            Content::Lost => return,
        };
        let path = if self.path.is_empty() { self.document.name } else { &self.path };
        self.document.faults.borrow_mut().push(Fault::new(path, value, allowed));
    }

    /// Notes that nothing may stand here: that it is `what` it is, and what is `allowed` instead.
    pub(super) fn refuse(&self, what: &str, allowed: &str) {
        if let Content::Json(text) = self.content {
            let value = format!("{what} ({})", shown(text));
            self.document.faults.borrow_mut().push(Fault::new(self.path.clone(), value, allowed));
        }
    }

    fn note_number(&self) {
        if let Content::Json(text) = self.content {
            self.document.numbers.borrow_mut().insert(self.path.clone(), shown(text));
        }
    }

    /// A finite number; every decimal text gives the nearest one.
    pub(super) fn number(&self) -> f64 {
        let number = match self.content {
            // Of all JSON values Rust's parser takes only numbers.
            Content::Json(text) => text.parse().ok().filter(|number: &f64| number.is_finite()),
            Content::Missing | Content::Lost => None,
        };
        self.note_number();
        number.unwrap_or_else(|| {
            self.fault("a finite number");
            0.0
        })
    }

    /// A whole number, however it is written (10, 10.0 or 1e1); messages call it `allowed`.
    pub(super) fn whole(&self, allowed: &str) -> usize {
        let number = match self.content {
            Content::Json(text) => text.parse().ok(),
            Content::Missing | Content::Lost => None,
        };
        self.note_number();
        number.and_then(|number: f64| number.to_string().parse().ok()).unwrap_or_else(|| {
            self.fault(allowed);
            0
        })
    }

    /// A list of `N` finite numbers.
    pub(super) fn vector<const N: usize>(&self) -> [f64; N] {
        self.note_number();
        let numbers: Option<[Value; N]> = self.items().and_then(|items| items.try_into().ok());
        if numbers.is_none() {
            self.fault(&format!("a list of {N} numbers"));
        }
        numbers.map_or([0.0; N], |numbers| numbers.map(|number| number.number()))
    }

    /// A text.
    pub(super) fn text(&self) -> String {
        self.parse().unwrap_or_else(|| {
            self.fault("a text in quotes");
            String::new()
        })
    }

    /// The meaning of one of some words; messages call them `allowed`.
    pub(super) fn choice<T: Copy>(&self, choices: &[(&str, T)], allowed: &str) -> Option<T> {
        let word: Option<String> = self.parse();
        let choice = choices.iter().find(|choice| word.as_deref() == Some(choice.0));
        if choice.is_none() {
            self.fault(allowed);
        }
        choice.map(|choice| choice.1)
    }

    /// Whether this is a list, of whatever.
    pub(super) fn is_list(&self) -> bool {
        matches!(self.content, Content::Json(text) if text.starts_with('['))
    }

    /// A list; messages call it `allowed`.
    pub(super) fn list(&self, allowed: &str) -> Vec<Value<'a>> {
        self.items().unwrap_or_else(|| {
            self.fault(allowed);
            Vec::new()
        })
    }

    fn items(&self) -> Option<Vec<Value<'a>>> {
        let item = |(i, raw): (usize, &'a RawValue)| Value {
            document: self.document,
            path: format!("{}[{i}]", self.path),
            content: Content::Json(raw.get()),
        };
        Some(self.parse::<Vec<&'a RawValue>>()?.into_iter().enumerate().map(item).collect())
    }

    /// The names in this object; none where it is something else.
    pub(super) fn names(&self) -> Vec<String> {
        self.parse::<Members>().map_or_else(Vec::new, |members| members.0.into_iter().map(|member| member.0).collect())
    }

    /// An object with no other fields than `fields`, each at most once.
    pub(super) fn object(&self, fields: &[&str]) -> Object<'a> {
        let members = self.parse::<Members<'a>>();
        let (document, path) = (self.document, self.path.clone());
        let object = Object { document, path, members: members.map(|members| members.0) };
        match &object.members {
            None => self.fault(&format!("an object with the fields {}", fields.join(", "))),
            Some(members) => {
                // At most one of each field, however long the file.
                let mut seen = Vec::with_capacity(fields.len());
                for (name, raw) in members {
                    let fault = |what: &str, allowed: String| {
                        let value = format!("{what} ({})", shown(raw.get()));
                        document.faults.borrow_mut().push(Fault::new(object.path_of(name), value, allowed));
                    };
                    if !fields.contains(&name.as_str()) {
                        fault("an unknown field", format!("the fields {}", fields.join(", ")));
                    } else if seen.contains(&name) {
                        fault("a second field of the same name", "each field once".into());
                    } else {
                        seen.push(name);
                    }
                }
            }
        }
        object
    }
}

/// An object whose fields can be asked for.
pub(super) struct Object<'a> {
    document: &'a Document,
    path: String,
    /// None where the object itself is at fault.
    members: Option<Vec<(String, &'a RawValue)>>,
}

impl<'a> Object<'a> {
    /// A field that has to be there.
    pub(super) fn field(&self, name: &str) -> Value<'a> {
        let absent = if self.members.is_some() { Content::Missing } else { Content::Lost };
        let content = self.find(name).map_or(absent, Content::Json);
        Value { document: self.document, path: self.path_of(name), content }
    }

    /// A field that may be missing.
    pub(super) fn optional(&self, name: &str) -> Option<Value<'a>> {
        self.find(name).map(|_| self.field(name))
    }

    fn find(&self, name: &str) -> Option<&'a str> {
        let mut members = self.members.iter().flatten();
        members.find(|(member, _)| member == name).map(|(_, raw)| raw.get())
    }

    fn path_of(&self, name: &str) -> String {
        let plain = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "_-".contains(c));
        match (plain, self.path.as_str()) {
            (true, "") => shown(name),
            (true, path) => format!("{path}.{}", shown(name)),
            (false, path) => format!("{path}[{}]", shown(&format!("{name:?}"))),
        }
    }
}

/// The members of an object in the order of the file, repeated names included.
struct Members<'a>(Vec<(String, &'a RawValue)>);

impl<'de> Deserialize<'de> for Members<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Collect;

        impl<'de> Visitor<'de> for Collect {
            type Value = Members<'de>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }

        deserializer.deserialize_map(Collect)
    }
}

/// JSON text on one line, cut where it is long.
fn shown(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}
