//! Undo and redo. What happens between pressing and releasing the pointer is one step, and so is what is typed or
//! repeated by keys within a second.

use eframe::egui::Context;
use eframe::egui::util::undoer::Undoer;

use crate::app::state::Document;

/// The states that the document has been in.
#[derive(Debug)]
pub struct History {
    undoer: Undoer<Document>,
}

impl History {
    /// The history of a document that was just opened.
    pub fn new(document: &Document) -> Self {
        let mut undoer = Undoer::default();
        undoer.add_undo(document);
        Self { undoer }
    }

    /// Looks at the document once per frame.
    pub fn watch(&mut self, context: &Context, document: &Document) {
        let (time, down, released) =
            context.input(|input| (input.time, input.pointer.any_down(), input.pointer.any_released()));
        if released {
            self.step(document);
        } else if !down {
            self.undoer.feed_state(time, document);
            if self.undoer.is_in_flux() {
                context.request_repaint_after(std::time::Duration::from_millis(200));
            }
        }
    }

    /// Ends a step.
    pub fn step(&mut self, document: &Document) {
        // Tells the undoer that the document has changed, so that what was undone cannot be redone on top of it.
        self.undoer.feed_state(0.0, document);
        self.undoer.add_undo(document);
    }

    /// The state before the last step.
    pub fn undo(&mut self, document: &Document) -> Option<Document> {
        self.undoer.undo(document).cloned()
    }

    /// The state that was undone last.
    pub fn redo(&mut self, document: &Document) -> Option<Document> {
        self.undoer.redo(document).cloned()
    }

    /// Whether there is a step to undo.
    pub fn can_undo(&self, document: &Document) -> bool {
        self.undoer.has_undo(document)
    }

    /// Whether there is a step to redo.
    pub fn can_redo(&self, document: &Document) -> bool {
        self.undoer.has_redo(document)
    }
}
