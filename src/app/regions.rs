//! The parts of the screen: where they were drawn, and how keys go from one to the next.

use eframe::egui::accesskit::{NodeId, Rect as Bounds, Role};
use eframe::egui::{Id, Rect, Sense, Ui};

use crate::app::tree::Item;

/// Where things were drawn in the last frame, in points. A thing that was not drawn keeps its last place.
#[derive(Clone, Copy, Debug)]
pub struct Regions {
    /// The canvas.
    pub canvas: Rect,
    /// The controls.
    pub controls: Rect,
    /// The critical speed with what belongs to it.
    pub answer: Rect,
    /// The open plot.
    pub plot: Rect,
}

impl Default for Regions {
    fn default() -> Self {
        Self { canvas: Rect::NOTHING, controls: Rect::NOTHING, answer: Rect::NOTHING, plot: Rect::NOTHING }
    }
}

/// Says that `rect` is a part of the screen with this name: F6 goes there, and scripts and screen readers find it. It
/// takes no clicks.
pub fn mark(ui: &Ui, rect: Rect, name: &'static str) {
    let id = Id::unique(("region", name));
    ui.interact(rect, id, Sense::empty());
    let [x0, y0, x1, y1] = [rect.left(), rect.top(), rect.right(), rect.bottom()].map(f64::from);
    ui.ctx().accesskit_node_builder(id, |node| {
        node.set_role(Role::Region);
        node.set_label(name);
        node.set_bounds(Bounds { x0, y0, x1, y1 });
    });
}

/// The region that an item lies in, by its place in `items`: the smallest one around its middle, since a card may lie over
/// the canvas.
pub fn around(item: &Item, items: &[Item]) -> Option<usize> {
    let holds = |(_, region): &(usize, &Item)| {
        region.holds_others() && region.node != item.node && region.rect.contains(item.rect.center())
    };
    let regions = items.iter().enumerate().filter(holds);
    regions.min_by(|(_, a), (_, b)| a.rect.area().total_cmp(&b.rect.area())).map(|(index, _)| index)
}

/// What gets the focus when it goes on to the next region, or back to the one before: the first thing in it that can have
/// it. Regions follow each other as they are read, and the first comes after the last; one with nothing to focus is passed.
pub fn next(items: &[Item], focused: Option<NodeId>, back: bool) -> Option<NodeId> {
    let mut stops: Vec<(usize, NodeId)> = Vec::new();
    for item in items.iter().filter(|item| item.focusable && item.enabled && !item.holds_others()) {
        if let Some(region) = around(item, items)
            && stops.iter().all(|(other, _)| *other != region)
        {
            stops.push((region, item.node));
        }
    }
    stops.sort_by(|(a, _), (b, _)| {
        let [a, b] = [items[*a].rect.min, items[*b].rect.min];
        a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x))
    });
    let here = items.iter().find(|item| Some(item.node) == focused).and_then(|item| around(item, items));
    let here = stops.iter().position(|(region, _)| Some(*region) == here);
    let index = match (here, back) {
        (Some(here), false) => (here + 1) % stops.len(),
        (Some(here), true) => (here + stops.len() - 1) % stops.len(),
        (None, false) => 0,
        (None, true) => stops.len().checked_sub(1)?,
    };
    stops.get(index).map(|(_, node)| *node)
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Pos2, Vec2};

    use super::*;

    fn item(node: u64, role: &'static str, [left, top, width, height]: [f32; 4]) -> Item {
        let rect = Rect::from_min_size(Pos2::new(left, top), Vec2::new(width, height));
        let (label, value) = (node.to_string(), None);
        Item { node: NodeId(node), label, role, rect, whole: rect, value, enabled: true, focusable: role == "button" }
    }

    /// A bar over controls and a canvas, which a card lies on; what is in them comes in no order.
    fn screen() -> Vec<Item> {
        vec![
            item(1, "region", [0.0, 0.0, 400.0, 40.0]),
            item(2, "region", [0.0, 40.0, 100.0, 260.0]),
            item(3, "region", [100.0, 40.0, 300.0, 260.0]),
            item(4, "region", [110.0, 50.0, 80.0, 50.0]),
            item(40, "button", [120.0, 60.0, 20.0, 20.0]),
            item(30, "button", [250.0, 150.0, 20.0, 20.0]),
            item(31, "button", [350.0, 150.0, 20.0, 20.0]),
            item(10, "button", [5.0, 5.0, 20.0, 20.0]),
            item(20, "button", [5.0, 50.0, 20.0, 20.0]),
        ]
    }

    #[test]
    fn regions_follow_each_other_as_they_are_read() {
        let items = screen();
        let go = |from: Option<u64>, back| next(&items, from.map(NodeId), back).map(|node| node.0);
        assert_eq!(
            [None, Some(10), Some(20), Some(30), Some(40)].map(|from| go(from, false)),
            [10, 20, 30, 40, 10].map(Some)
        );
        assert_eq!(
            [None, Some(10), Some(20), Some(30), Some(40)].map(|from| go(from, true)),
            [40, 40, 10, 20, 30].map(Some)
        );
        // From within one it is not far to the next either.
        assert_eq!(go(Some(31), false), Some(40));
    }

    #[test]
    fn a_region_with_nothing_to_focus_is_passed() {
        let mut items = screen();
        items.retain(|item| item.node != NodeId(20));
        assert_eq!(next(&items, Some(NodeId(10)), false), Some(NodeId(30)));
        items.retain(|item| item.role == "region");
        assert_eq!([false, true].map(|back| next(&items, None, back)), [None, None]);
    }
}
