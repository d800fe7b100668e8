//! What is on the screen, by name: egui's tree for screen readers as a list of things with their roles and places.
//!
//! A page is a canvas to its browser. So scripts and tests that press things by name, keys that go from region to region,
//! and the words for screen readers all read this list. It is made only when somebody asks for it; a frame does no more
//! than keep the tree.

use std::collections::HashMap;

use eframe::egui::accesskit::{Action, Node, NodeId, Role, Toggled, TreeUpdate};
use eframe::egui::{Context, FullOutput, Id, Plugin, Pos2, Rect, pos2};
use serde_json::{Value as Json, json};

/// Has the tree kept from now on. In a browser it is always made; on a desktop only while something reads the screen.
pub fn install(context: &Context) {
    context.add_plugin(Tree::default());
}

/// The tree of the last pass. egui gives all of it each time.
#[derive(Default)]
struct Tree(Option<TreeUpdate>);

impl Plugin for Tree {
    fn debug_name(&self) -> &'static str {
        "Tree"
    }

    fn setup(&mut self, context: &Context) {
        if cfg!(target_arch = "wasm32") {
            context.enable_accesskit();
        }
    }

    fn output_hook(&mut self, _: &Context, output: &mut FullOutput) {
        let update = &mut output.platform_output.accesskit_update;
        // A browser has nobody else who wants it.
        self.0 = if cfg!(target_arch = "wasm32") { update.take() } else { update.clone() };
    }
}

/// A thing on the screen that has a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Its number in the tree.
    pub node: NodeId,
    /// Its name.
    pub label: String,
    /// What it is: a role of ARIA, or "text" for words that only stand there.
    pub role: &'static str,
    /// What is seen of it, in points.
    pub rect: Rect,
    /// All of it, in points.
    pub whole: Rect,
    /// What it is set to.
    pub value: Option<Value>,
    /// Whether it can be used.
    pub enabled: bool,
    /// Whether it can have the keyboard's focus.
    pub focusable: bool,
}

/// What a control is set to.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// As it is written.
    Text(String),
    /// A number that is not written.
    Number(f64),
    /// On or off, chosen or not.
    Is(bool),
}

impl Item {
    /// Whether it is a part of the screen with other things in it.
    pub fn holds_others(&self) -> bool {
        matches!(self.role, "region" | "dialog")
    }

    /// Whether it can be in a state in which it cannot be used.
    fn is_control(&self) -> bool {
        !self.holds_others() && !matches!(self.role, "text" | "img" | "figure" | "tooltip" | "heading" | "group")
    }

    fn json(&self, zoom: f64) -> Json {
        let mut json = json!({ "label": self.label, "role": self.role, "rect": pixels(self.rect, zoom) });
        match &self.value {
            Some(Value::Text(text)) => json["value"] = text.as_str().into(),
            Some(Value::Number(number)) => json["value"] = (*number).into(),
            Some(Value::Is(on)) => json["value"] = (*on).into(),
            None => {}
        }
        if self.is_control() {
            json["enabled"] = self.enabled.into();
        }
        if self.rect != self.whole {
            json["whole"] = pixels(self.whole, zoom);
        }
        json
    }
}

/// Left, top, width and height in the pixels of a style sheet, where a point is `zoom` of them.
fn pixels(rect: Rect, zoom: f64) -> Json {
    let exact = [rect.left(), rect.top(), rect.width(), rect.height()];
    exact.map(|points| (f64::from(points) * zoom * 100.0).round() / 100.0).to_vec().into()
}

/// The items as scripts read them: each with label, role and rect, with value and enabled where they apply, and with
/// `whole` where it is partly hidden by the edge of the window or of what scrolls.
pub fn layout(context: &Context) -> Json {
    let zoom = f64::from(context.zoom_factor());
    items(context).iter().map(|item| item.json(zoom)).collect()
}

/// All things on the screen that have a name, in the order in which they were drawn; nothing where no tree is made.
pub fn items(context: &Context) -> Vec<Item> {
    let places = places(context);
    let screen = context.content_rect();
    with_update(context, |update| list(update, screen, |node| places.get(&node).map(|(_, place)| *place)))
        .unwrap_or_default()
}

/// The thing with the keyboard's focus.
pub fn focused(context: &Context) -> Option<NodeId> {
    with_update(context, |update| update.focus)
}

/// What the node is to egui.
pub fn widget(context: &Context, node: NodeId) -> Option<Id> {
    places(context).get(&node).map(|(id, _)| *id)
}

fn with_update<R>(context: &Context, read: impl FnOnce(&TreeUpdate) -> R) -> Option<R> {
    context.with_plugin(|tree: &mut Tree| tree.0.as_ref().map(read)).flatten()
}

/// Where a widget is, and what is seen of it where something cuts it off.
#[derive(Clone, Copy, Debug)]
struct WidgetPlace {
    whole: Rect,
    seen: Rect,
}

/// Where all widgets of the last pass are: the tree knows nothing of what is cut off.
fn places(context: &Context) -> HashMap<NodeId, (Id, WidgetPlace)> {
    context.viewport(|viewport| {
        let widgets = viewport.prev_pass.widgets.layers().flat_map(|(_, widgets)| widgets);
        let place = |rect: Rect, seen: Rect| WidgetPlace { whole: rect, seen: seen.intersect(rect) };
        widgets.map(|it| (it.id.accesskit_id(), (it.id, place(it.rect, it.interact_rect)))).collect()
    })
}

/// The named things of a tree that are seen on the screen.
fn list(update: &TreeUpdate, screen: Rect, place: impl Fn(NodeId) -> Option<WidgetPlace>) -> Vec<Item> {
    let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
    let mut items = Vec::new();
    let mut waiting: Vec<NodeId> = update.tree.iter().map(|tree| tree.root).collect();
    // Each node once, whatever the tree says.
    for _ in 0..update.nodes.len() {
        let Some(id) = waiting.pop() else { break };
        let Some(node) = nodes.get(&id).filter(|node| !node.is_hidden()) else { continue };
        waiting.extend(node.children().iter().rev());
        let Some(role) = aria(node.role()) else { continue };
        let Some(label) = name(node, &nodes) else { continue };
        let in_tree = || node.bounds().map(|bounds| corners([bounds.x0, bounds.y0], [bounds.x1, bounds.y1]));
        let place = place(id).or_else(|| in_tree().map(|rect| WidgetPlace { whole: rect, seen: rect }));
        let Some(WidgetPlace { whole, seen }) = place.filter(|place| place.whole.is_finite()) else { continue };
        let rect = seen.intersect(screen);
        if !rect.is_positive() {
            continue;
        }
        let value = if role == "text" { None } else { value(node) };
        let (enabled, focusable) = (!node.is_disabled(), node.supports_action(Action::Focus));
        items.push(Item { node: id, label, role, rect, whole, value, enabled, focusable });
    }
    items
}

/// Points are small numbers.
#[expect(clippy::cast_possible_truncation)]
fn corners([left, top]: [f64; 2], [right, bottom]: [f64; 2]) -> Rect {
    let point = |x: f64, y: f64| -> Pos2 { pos2(x as f32, y as f32) };
    Rect::from_min_max(point(left, top), point(right, bottom))
}

/// Its own name, else that of the words that stand beside it, else what it asks for.
fn name(node: &Node, nodes: &HashMap<NodeId, &Node>) -> Option<String> {
    let own = |node: &Node| {
        let words = if node.role() == Role::Label { node.label().or(node.value()) } else { node.label() };
        words.map(|words| words.trim().to_owned()).filter(|words| !words.is_empty())
    };
    let beside = || {
        let names: Vec<String> = node.labelled_by().iter().filter_map(|id| own(nodes.get(id)?)).collect();
        (!names.is_empty()).then(|| names.join(" "))
    };
    own(node).or_else(beside).or_else(|| node.placeholder().map(str::to_owned))
}

fn value(node: &Node) -> Option<Value> {
    let text = node.value().map(|text| Value::Text(text.to_owned()));
    let number = || node.numeric_value().map(Value::Number);
    // Half on is not off.
    let is =
        || node.toggled().map(|toggled| Value::Is(toggled != Toggled::False)).or(node.is_selected().map(Value::Is));
    text.or_else(number).or_else(is)
}

/// ARIA's name of a role; nothing for what only holds other things together.
fn aria(role: Role) -> Option<&'static str> {
    Some(match role {
        Role::Button | Role::DefaultButton | Role::DisclosureTriangle | Role::ColorWell => "button",
        Role::CheckBox => "checkbox",
        Role::Switch => "switch",
        Role::RadioButton => "radio",
        Role::RadioGroup => "radiogroup",
        Role::Slider => "slider",
        Role::SpinButton | Role::NumberInput => "spinbutton",
        Role::TextInput | Role::MultilineTextInput => "textbox",
        Role::SearchInput => "searchbox",
        Role::ComboBox | Role::EditableComboBox => "combobox",
        Role::ListBox => "listbox",
        Role::ListBoxOption | Role::MenuListOption => "option",
        Role::Tab => "tab",
        Role::TabList => "tablist",
        Role::TabPanel => "tabpanel",
        Role::Link => "link",
        Role::Image | Role::Canvas => "img",
        Role::Figure => "figure",
        Role::Menu => "menu",
        Role::MenuBar => "menubar",
        Role::MenuItem => "menuitem",
        Role::MenuItemCheckBox => "menuitemcheckbox",
        Role::MenuItemRadio => "menuitemradio",
        Role::Dialog | Role::AlertDialog | Role::Window => "dialog",
        Role::Alert => "alert",
        Role::Status => "status",
        Role::Tooltip => "tooltip",
        Role::Region => "region",
        Role::Toolbar => "toolbar",
        Role::Group => "group",
        Role::Table | Role::Grid => "table",
        Role::Row => "row",
        Role::Cell | Role::GridCell => "cell",
        Role::ColumnHeader => "columnheader",
        Role::RowHeader => "rowheader",
        Role::List => "list",
        Role::ListItem => "listitem",
        Role::Heading => "heading",
        Role::ProgressIndicator => "progressbar",
        Role::Meter => "meter",
        Role::Splitter => "separator",
        Role::ScrollBar => "scrollbar",
        Role::Label | Role::Paragraph => "text",
        Role::Unknown => "generic",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use eframe::egui::accesskit::{Rect as Bounds, TreeId, TreeInfo};

    use super::*;

    const SCREEN: Rect = Rect { min: Pos2::ZERO, max: pos2(400.0, 300.0) };

    fn node(role: Role, label: &str, bounds: [f64; 4]) -> Node {
        let mut node = Node::new(role);
        if !label.is_empty() {
            node.set_label(label);
        }
        let [x0, y0, x1, y1] = bounds;
        node.set_bounds(Bounds { x0, y0, x1, y1 });
        node
    }

    /// A tree whose root has these nodes, numbered from 1, in this order.
    fn tree(nodes: Vec<Node>) -> TreeUpdate {
        let mut root = node(Role::Window, "The window itself", [0.0, 0.0, 400.0, 300.0]);
        root.clear_label();
        let numbered: Vec<(NodeId, Node)> =
            nodes.into_iter().enumerate().map(|(i, it)| (NodeId(i as u64 + 1), it)).collect();
        root.set_children(numbered.iter().map(|(id, _)| *id).collect::<Vec<_>>());
        // egui's nodes come in any order.
        let nodes = numbered.into_iter().rev().chain([(NodeId(0), root)]).collect();
        TreeUpdate { nodes, tree: Some(TreeInfo::new(NodeId(0))), tree_id: TreeId::ROOT, focus: NodeId(0) }
    }

    fn listed(nodes: Vec<Node>) -> Vec<Item> {
        list(&tree(nodes), SCREEN, |_| None)
    }

    #[test]
    fn things_come_with_name_role_place_value_and_whether_they_can_be_used() {
        let mut slider = node(Role::Slider, "Speed v", [10.0, 20.0, 110.0, 44.0]);
        slider.set_numeric_value(5.0);
        slider.add_action(Action::Focus);
        let mut undo = node(Role::Button, "Undo", [120.0, 20.0, 150.0, 44.0]);
        undo.set_disabled();
        let mut map = node(Role::Button, "Map", [160.0, 20.0, 190.0, 44.0]);
        map.set_toggled(Toggled::True);
        let items = listed(vec![slider, undo, map]);
        let json: Vec<Json> = items.iter().map(|item| item.json(1.0)).collect();
        assert_eq!(
            json,
            [
                json!({ "label": "Speed v", "role": "slider", "rect": [10.0, 20.0, 100.0, 24.0], "value": 5.0, "enabled": true }),
                json!({ "label": "Undo", "role": "button", "rect": [120.0, 20.0, 30.0, 24.0], "enabled": false }),
                json!({ "label": "Map", "role": "button", "rect": [160.0, 20.0, 30.0, 24.0], "value": true, "enabled": true }),
            ]
        );
        assert!(items[0].focusable && !items[1].focusable);
    }

    #[test]
    fn larger_texts_make_points_larger_than_pixels() {
        let items = listed(vec![node(Role::Tab, "Modes", [10.0, 20.0, 30.0, 44.0])]);
        assert_eq!(items[0].json(1.5)["rect"], json!([15.0, 30.0, 30.0, 36.0]));
    }

    #[test]
    fn a_control_is_called_by_the_words_beside_it_and_words_are_text() {
        let mut words = Node::new(Role::Label);
        words.set_value("Young's modulus E");
        words.set_bounds(Bounds { x0: 0.0, y0: 0.0, x1: 90.0, y1: 20.0 });
        let mut field = node(Role::SpinButton, "", [100.0, 0.0, 160.0, 20.0]);
        field.push_labelled_by(NodeId(1));
        field.set_value("125 MPa");
        field.set_numeric_value(125.0);
        let items = listed(vec![words, field]);
        let of = |item: &Item| (item.role, item.label.clone(), item.value.clone());
        assert_eq!(of(&items[0]), ("text", "Young's modulus E".into(), None));
        assert_eq!(of(&items[1]), ("spinbutton", "Young's modulus E".into(), Some(Value::Text("125 MPa".into()))));
    }

    #[test]
    fn what_has_no_name_or_is_not_seen_is_left_out_with_what_only_holds_others() {
        let mut hidden = node(Role::Button, "Hidden", [0.0, 0.0, 20.0, 20.0]);
        hidden.set_hidden();
        let items = listed(vec![
            node(Role::Button, "", [0.0, 0.0, 20.0, 20.0]),
            node(Role::GenericContainer, "Box", [0.0, 0.0, 20.0, 20.0]),
            node(Role::TextRun, "a", [0.0, 0.0, 20.0, 20.0]),
            node(Role::Button, "Below the window", [0.0, 310.0, 20.0, 330.0]),
            node(Role::Button, "Nowhere", [f64::INFINITY, 0.0, f64::NEG_INFINITY, 20.0]),
            hidden,
            node(Role::Button, "Seen", [0.0, 280.0, 20.0, 320.0]),
        ]);
        let names: Vec<&str> = items.iter().map(|item| item.label.as_str()).collect();
        assert_eq!(names, ["Seen"]);
        let json = items[0].json(1.0);
        assert_eq!(
            (&json["rect"], &json["whole"]),
            (&json!([0.0, 280.0, 20.0, 20.0]), &json!([0.0, 280.0, 20.0, 40.0]))
        );
    }

    #[test]
    fn what_scrolls_hides_what_is_beyond_its_edge() {
        let rect = |top: f32, bottom: f32| Rect::from_min_max(pos2(0.0, top), pos2(50.0, bottom));
        // A list that shows 100 … 200; the tree has the places of all its rows.
        let rows = [rect(80.0, 95.0), rect(95.0, 115.0), rect(115.0, 135.0)];
        let nodes = rows.map(|row| node(Role::Button, "Row", [0.0, row.top().into(), 50.0, row.bottom().into()]));
        let place = |id: NodeId| {
            let row = *rows.get(usize::try_from(id.0).ok()?.checked_sub(1)?)?;
            Some(WidgetPlace { whole: row, seen: row.intersect(rect(100.0, 200.0)) })
        };
        let items = list(&tree(nodes.to_vec()), SCREEN, place);
        let seen: Vec<Rect> = items.iter().map(|item| item.rect).collect();
        assert_eq!(seen, [rect(100.0, 115.0), rect(115.0, 135.0)]);
        assert!(items[0].json(1.0).get("whole").is_some() && items[1].json(1.0).get("whole").is_none());
    }
}
