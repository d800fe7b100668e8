//! Start-up of the desktop application, the command line and the page.

struct Hello;

impl eframe::App for Hello {
    fn ui(&mut self, ui: &mut eframe::egui::Ui, _frame: &mut eframe::Frame) {
        ui.heading("Tautline");
    }
}

#[cfg(target_arch = "wasm32")]
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

#[cfg(not(target_arch = "wasm32"))]
fn main() -> eframe::Result {
    eframe::run_native("Tautline", eframe::NativeOptions::default(), Box::new(|_| Ok(Box::new(Hello))))
}
