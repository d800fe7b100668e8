//! How things are looked at, as the part of a link that follows the robot: `#s=…&plot=line&map=speed&panels=0`.
//!
//! Durable, as the robot's part is: names stay, and what is unknown is ignored.

use std::fmt::Write as _;

use crate::app::settings::{TEXT_SIZES, ThemeChoice};
use crate::app::state::{MapQuantity, Panels, Plot, Session, UiState};
use crate::app::tour::Tour;
use crate::scenario::link;

/// What maps can show, by their names in links.
const MAPS: [(MapQuantity, &str); 6] = [
    (MapQuantity::Speed, "speed"),
    (MapQuantity::Frequency, "frequency"),
    (MapQuantity::Kind, "kind"),
    (MapQuantity::Cable, "cable"),
    (MapQuantity::Growth, "growth"),
    (MapQuantity::Waves, "waves"),
];

const THEMES: [(ThemeChoice, &str); 3] =
    [(ThemeChoice::System, "system"), (ThemeChoice::Light, "light"), (ThemeChoice::Dark, "dark")];

/// The view as it follows a robot in a link: nothing of what is as it is at first.
pub fn encode(state: &UiState, session: &Session) -> String {
    let first = UiState::default();
    let mut out = String::new();
    let mut add = |name: &str, value: &str| {
        // Writing to a string does not fail.
        let _ = write!(out, "&{name}={value}");
    };
    for (name, plot, at_first) in [("plot", state.plot, first.plot), ("dock", state.dock, first.dock)] {
        if plot != at_first {
            add(name, plot.name());
        }
    }
    if state.map.on {
        if let Some((_, name)) = MAPS.iter().find(|(quantity, _)| *quantity == state.map.quantity) {
            add("map", name);
        }
        if state.map.worst {
            add("worst", "1");
        }
    }
    let Panels { left, right, dock, .. } = state.panels;
    if !(left && right && dock) {
        let open: String = [(left, 'l'), (right, 'r'), (dock, 'd')].iter().filter(|it| it.0).map(|it| it.1).collect();
        add("panels", if open.is_empty() { "0" } else { &open });
    }
    if state.settings.theme != first.settings.theme
        && let Some((_, name)) = THEMES.iter().find(|(theme, _)| *theme == state.settings.theme)
    {
        add("theme", name);
    }
    if session.present {
        add("present", "1");
    }
    if state.settings.text_percent != first.settings.text_percent {
        add("text", &state.settings.text_percent.to_string());
    }
    out
}

/// The part of a text about the view, where the text is a link and has such a part.
pub fn part(text: &str) -> Option<&str> {
    let (_, fragment) = text.split_once(link::MARK).filter(|_| !text.trim_start().starts_with('{'))?;
    fragment.find('&').map(|begin| &fragment[begin..])
}

/// Looks at things as a link says, as far as it says anything: `text` is what [`encode`] gave.
///
/// Programs that pass links on may write `&` as `&amp;`, encode it by percent, or put a full stop behind it.
pub fn apply(text: &str, state: &mut UiState, session: &mut Session) {
    let text = percent_encoding::percent_decode_str(text).decode_utf8_lossy();
    let text = text.trim_end_matches(|c: char| !c.is_ascii_alphanumeric());
    for request in text.split('&') {
        if let Some((name, value)) = request.strip_prefix("amp;").unwrap_or(request).split_once('=') {
            set(name, value, state, session);
        }
    }
}

fn set(name: &str, value: &str, state: &mut UiState, session: &mut Session) {
    let switch = match value {
        "1" => Some(true),
        "0" => Some(false),
        _ => None,
    };
    match (name, switch) {
        ("plot", _) => state.plot = plot(value).unwrap_or(state.plot),
        ("dock", _) => state.dock = plot(value).unwrap_or(state.dock),
        ("map", _) if value == "off" => state.map.on = false,
        ("map", _) => {
            if let Some((quantity, _)) = MAPS.iter().find(|(_, name)| *name == value) {
                (state.map.on, state.map.quantity) = (true, *quantity);
            }
        }
        ("worst", Some(on)) => state.map.worst = on,
        ("panels", _) if value == "0" || (!value.is_empty() && value.chars().all(|c| "lrd".contains(c))) => {
            let open = |letter| value.contains(letter);
            let left = open('l');
            state.panels = Panels { left, left_where_narrow: left, right: open('r'), dock: open('d'), ..state.panels };
        }
        ("tour", Some(on)) => session.tour = on.then(Tour::default),
        ("theme", _) => {
            if let Some((theme, _)) = THEMES.iter().find(|(_, name)| *name == value) {
                state.settings.theme = *theme;
            }
        }
        ("present", Some(on)) => session.present = on,
        ("text", _) => {
            if let Some(percent) = value.parse().ok().filter(|percent| TEXT_SIZES.contains(percent)) {
                state.settings.text_percent = percent;
            }
        }
        _ => {}
    }
}

fn plot(name: &str) -> Option<Plot> {
    Plot::all().find(|plot| plot.name() == name)
}

/// The lines that show a link as a frame in another page: the robot first, without panels and without the tour.
pub fn embed(link: &str) -> String {
    let mut source = format!("{link}&panels=0&tour=0");
    for (letter, written) in [("&", "&amp;"), ("\"", "&quot;"), ("<", "&lt;"), (">", "&gt;")] {
        source = source.replace(letter, written);
    }
    format!(
        "<iframe src=\"{source}\" width=\"600\" height=\"400\" title=\"Tautline: a cable robot to try out\" \
         loading=\"lazy\" allow=\"clipboard-write\"></iframe>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (UiState, Session) {
        let (mut state, mut session) = (UiState::default(), Session::default());
        apply(text, &mut state, &mut session);
        (state, session)
    }

    #[test]
    fn a_view_as_it_is_at_first_needs_no_words() {
        assert_eq!(encode(&UiState::default(), &Session::default()), "");
    }

    #[test]
    fn the_contracts_example_says_all_that_it_says() {
        let (state, session) = read("&plot=line&map=speed&panels=0&tour=0&theme=dark&present=1");
        assert_eq!(state.plot, Plot::Line);
        assert!(state.map.on && state.map.quantity == MapQuantity::Speed && !state.map.worst);
        assert!(!state.panels.left && !state.panels.right && !state.panels.dock);
        assert_eq!(state.settings.theme, ThemeChoice::Dark);
        assert!(session.present && session.tour.is_none());
        assert_eq!(encode(&state, &session), "&plot=line&map=speed&panels=0&theme=dark&present=1");
        assert!(read("&tour=1").1.tour.is_some());
    }

    #[test]
    fn every_plot_map_theme_and_set_of_panels_comes_back() {
        for plot in Plot::all() {
            for (quantity, _) in MAPS {
                for (theme, _) in THEMES {
                    let mut state = UiState { plot, dock: plot, ..UiState::default() };
                    (state.map.on, state.map.quantity, state.map.worst) =
                        (true, quantity, quantity == MapQuantity::Cable);
                    (state.panels.left, state.panels.dock) = (plot == Plot::Mesh, theme == ThemeChoice::Light);
                    (state.settings.theme, state.settings.text_percent) = (theme, 150);
                    let (again, _) = read(&encode(&state, &Session::default()));
                    let seen = |state: &UiState| {
                        let Panels { left, right, dock, .. } = state.panels;
                        let settings = (state.settings.theme, state.settings.text_percent);
                        (state.plot, state.dock, state.map, [left, right, dock], settings)
                    };
                    assert_eq!(seen(&again), seen(&state));
                }
            }
        }
    }

    #[test]
    fn what_is_unknown_changes_nothing() {
        let text =
            "&plot=cake&dock=&map=rain&worst=2&panels=xyz&tour=maybe&theme=pink&present&text=9000&text=79&future=1&&=&";
        let (state, session) = read(text);
        assert_eq!(encode(&state, &session), "");
        assert_eq!(session.tour, None);
    }

    #[test]
    fn links_survive_what_programs_do_to_them() {
        for text in [
            "&plot=modes&text=120",
            "&amp;plot=modes&amp;text=120",
            "%26plot%3Dmodes%26text%3D120",
            "&plot=modes&text=120.)",
        ] {
            let (state, _) = read(text);
            assert_eq!((state.plot, state.settings.text_percent), (Plot::Modes, 120), "{text}");
        }
    }

    #[test]
    fn only_links_have_a_part_about_the_view() {
        assert_eq!(part("https://a.b/c#s=1AbC-_&plot=line&map=speed"), Some("&plot=line&map=speed"));
        assert_eq!(part("#s=1AbC"), None);
        assert_eq!(part("plot=line&map=speed"), None);
        assert_eq!(part(r##"{ "name": "#s=1&plot=line" }"##), None);
    }

    #[test]
    fn a_frame_shows_the_robot_first_and_nothing_gets_out_of_its_address() {
        let lines = embed("https://a.b/?q=\"><script>#s=1AbC&theme=dark");
        let source = "https://a.b/?q=&quot;&gt;&lt;script&gt;#s=1AbC&amp;theme=dark&amp;panels=0&amp;tour=0";
        assert!(
            lines.starts_with(&format!("<iframe src=\"{source}\" width=\"600\" height=\"400\" title=\"")),
            "{lines}"
        );
        assert!(lines.ends_with("allow=\"clipboard-write\"></iframe>"));
        assert_eq!(lines.matches('<').count(), 2);
    }
}
