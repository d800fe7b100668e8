//! Start-up of the desktop application, the command line and the page.

#[cfg(feature = "app")]
struct Hello;

#[cfg(feature = "app")]
impl eframe::App for Hello {
    fn ui(&mut self, ui: &mut eframe::egui::Ui, _frame: &mut eframe::Frame) {
        ui.heading("Tautline");
    }
}

#[cfg(all(feature = "app", target_arch = "wasm32"))]
fn main() {
    use wasm_bindgen::JsCast as _;
    console_error_panic_hook::set_once();
    let canvas = web_sys::window()
        .and_then(|w| w.document())
        .and_then(|d| d.get_element_by_id("tautline-canvas"))
        .and_then(|e| e.dyn_into::<web_sys::HtmlCanvasElement>().ok());
    let Some(canvas) = canvas else { return };
    wasm_bindgen_futures::spawn_local(async move {
        let _ = eframe::WebRunner::new()
            .start(canvas, eframe::WebOptions::default(), Box::new(|_| Ok(Box::new(Hello))))
            .await;
    });
}

#[cfg(all(feature = "app", not(target_arch = "wasm32")))]
fn main() -> eframe::Result {
    eframe::run_native("Tautline", eframe::NativeOptions::default(), Box::new(|_| Ok(Box::new(Hello))))
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

#[cfg(not(any(feature = "app", all(feature = "cli", not(target_arch = "wasm32")))))]
fn main() {}
