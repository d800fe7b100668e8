//! Start-up of the desktop application, the command line and the page.

#[cfg(all(feature = "app", target_arch = "wasm32"))]
fn main() {
    use tautline::app::{Start, Tautline, is_embedded, take_kept, take_link};
    use wasm_bindgen::JsCast as _;

    console_error_panic_hook::set_once();
    let canvas = web_sys::window()
        .and_then(|window| window.document())
        .and_then(|document| document.get_element_by_id("tautline-canvas"))
        .and_then(|element| element.dyn_into::<web_sys::HtmlCanvasElement>().ok());
    let Some(canvas) = canvas else {
        web_sys::console::error_1(&"the page has no canvas \"tautline-canvas\"".into());
        return;
    };
    wasm_bindgen_futures::spawn_local(async move {
        let create: eframe::AppCreator<'static> = Box::new(|context| {
            let (scenario, link, embedded) = (take_kept(), take_link(), is_embedded());
            Ok(Box::new(Tautline::new(context, Start { scenario, link, tour: !embedded, embedded })))
        });
        if let Err(error) = eframe::WebRunner::new().start(canvas, eframe::WebOptions::default(), create).await {
            // The page hears of it and tells it.
            wasm_bindgen::throw_val(error);
        }
    });
}

#[cfg(all(feature = "app", feature = "cli", not(target_arch = "wasm32")))]
fn main() -> std::process::ExitCode {
    use tautline::app::{Start, Tautline};
    use tautline::cli;

    let scenario = match cli::run() {
        cli::Start::Done(code) => return code,
        cli::Start::App { scenario } => scenario.map(|scenario| *scenario),
    };
    // For pictures and tests; otherwise the system's theme counts.
    let theme = match std::env::var("TAUTLINE_THEME").unwrap_or_default().as_str() {
        "light" => Some(eframe::egui::Theme::Light),
        "dark" => Some(eframe::egui::Theme::Dark),
        _ => None,
    };
    let viewport =
        eframe::egui::ViewportBuilder::default().with_inner_size([1280.0, 800.0]).with_min_inner_size([340.0, 480.0]);
    let options = eframe::NativeOptions { viewport, ..Default::default() };
    let create: eframe::AppCreator<'static> = Box::new(move |context| {
        if let Some(theme) = theme {
            context.egui_ctx.set_theme(theme);
        }
        Ok(Box::new(Tautline::new(context, Start { scenario, tour: true, ..Start::default() })))
    });
    match eframe::run_native("Tautline", options, create) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => cli::fail(&format!("the window could not be opened: {error}")),
    }
}

#[cfg(all(feature = "cli", not(feature = "app"), not(target_arch = "wasm32")))]
fn main() -> std::process::ExitCode {
    match tautline::cli::run() {
        tautline::cli::Start::Done(code) => code,
        tautline::cli::Start::App { .. } => {
            tautline::cli::fail("this build has no window; tautline --help says what it can do")
        }
    }
}

#[cfg(not(any(feature = "cli", all(feature = "app", target_arch = "wasm32"))))]
fn main() {}
