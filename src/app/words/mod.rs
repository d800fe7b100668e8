//! Words that open a card: what they mean, with a small picture, from anywhere they stand.

mod card;
mod explanation;
mod links;
mod pictures;
mod texts;
mod word;

pub use card::{is_open, ui};
pub use explanation::explain;
pub use links::link;
pub use word::Word;
