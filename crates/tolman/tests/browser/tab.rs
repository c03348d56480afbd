//! A page as somebody has it before them: looked at, clicked, typed on.

use core::time::Duration;
use std::path::Path;
use std::time::Instant;

use serde_json::{Value, json};

use crate::devtools::Devtools;

/// What a page waits for has come by then.
const PATIENCE: Duration = Duration::from_secs(10);

/// One tab of a browser of its own.
#[derive(Debug)]
pub(crate) struct Tab {
    devtools: Devtools,
    session: String,
}

/// Colours that the reader's system prefers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    Light,
    Dark,
}

/// Properties of the picture of a page.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// Number of colours in the picture.
    colours: u64,
    /// Share of the picture that has its most frequent colour, 0 to 1.
    pub(crate) ground: f64,
    /// Mean lightness of the picture, 0 to 1.
    lightness: f64,
}

impl Tab {
    pub(crate) fn open() -> Option<Self> {
        let mut devtools = Devtools::start()?;
        let target = devtools.call(
            None,
            "Target.createTarget",
            &json!({ "url": "about:blank" }),
        );
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        let attached = devtools.call(None, "Target.attachToTarget", &attach);
        let mut tab = Self {
            devtools,
            session: attached["sessionId"].as_str().unwrap().to_owned(),
        };
        for domain in ["Page", "Runtime", "Log", "Network"] {
            tab.call(&format!("{domain}.enable"), &json!({}));
        }
        tab.resize(1200, 800);
        Some(tab)
    }

    #[track_caller]
    fn call(&mut self, method: &str, params: &Value) -> Value {
        self.devtools.call(Some(&self.session), method, params)
    }

    /// Opens a file, with this behind its path, and waits until all of it is there.
    #[track_caller]
    pub(crate) fn load(&mut self, file: &Path, anchor: &str) {
        let url = format!("file://{}{anchor}", file.display());
        let answer = self.call("Page.navigate", &json!({ "url": url }));
        assert!(answer["errorText"].is_null(), "{url}: {answer}");
        // Another anchor of the page that is open loads nothing.
        if answer["loaderId"].is_string() {
            self.devtools.wait_for("Page.loadEventFired");
        }
    }

    /// Returns the value of an expression; a promise is awaited.
    #[track_caller]
    pub(crate) fn eval(&mut self, expression: &str) -> Value {
        let params = json!({
            "expression": expression,
            "awaitPromise": true,
            "returnByValue": true,
            "userGesture": true,
        });
        let mut answer = self.call("Runtime.evaluate", &params);
        let failed = &answer["exceptionDetails"];
        assert!(failed.is_null(), "{expression}: {failed}");
        answer["result"]["value"].take()
    }

    /// Returns the value of an expression that is a number.
    #[track_caller]
    pub(crate) fn number(&mut self, expression: &str) -> f64 {
        let value = self.eval(expression);
        assert!(value.is_number(), "{expression} is {value}");
        value.as_f64().unwrap()
    }

    /// Returns the value of an expression that is a whole number.
    #[track_caller]
    pub(crate) fn whole(&mut self, expression: &str) -> u64 {
        let value = self.eval(expression);
        assert!(value.is_u64(), "{expression} is {value}");
        value.as_u64().unwrap()
    }

    /// Waits until a condition holds.
    #[track_caller]
    pub(crate) fn until(&mut self, condition: &str) {
        self.until_within(condition, PATIENCE);
    }

    /// Waits at most `patience` until a condition holds.
    #[track_caller]
    pub(crate) fn until_within(&mut self, condition: &str, patience: Duration) {
        let begun = Instant::now();
        while self.eval(condition) != true {
            assert!(begun.elapsed() < patience, "it never came: {condition}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Clicks into the middle of the first element that a CSS selector means, as a mouse does:
    /// whatever lies above it gets the click.
    #[track_caller]
    pub(crate) fn click(&mut self, selector: &str) {
        let place = self.eval(&format!(
            "(() => {{ const element = document.querySelector({selector:?});
               element.scrollIntoView({{ block: 'center', behavior: 'instant' }});
               const box = element.getBoundingClientRect();
               return [box.x + box.width / 2, box.y + box.height / 2]; }})()"
        ));
        for kind in ["mousePressed", "mouseReleased"] {
            let params = json!({
                "type": kind, "x": place[0], "y": place[1], "button": "left", "clickCount": 1,
            });
            self.call("Input.dispatchMouseEvent", &params);
        }
    }

    /// Strikes a key, by the names that the web has for it (`KeyboardEvent.key` and the code of the
    /// key of old).
    #[track_caller]
    pub(crate) fn strike(&mut self, key: &str, code: u32) {
        let text = match key {
            "Enter" => "\r",
            key if key.chars().count() == 1 => key,
            _ => "",
        };
        for kind in ["keyDown", "keyUp"] {
            let mut params = json!({
                "type": kind, "key": key, "windowsVirtualKeyCode": code,
            });
            if kind == "keyDown" && !text.is_empty() {
                params["text"] = text.into();
            }
            self.call("Input.dispatchKeyEvent", &params);
        }
    }

    /// Gives the page this many pixels; up to a phone's width it is a phone.
    #[track_caller]
    pub(crate) fn resize(&mut self, width: u32, height: u32) {
        let params = json!({
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500,
        });
        self.call("Emulation.setDeviceMetricsOverride", &params);
    }

    pub(crate) fn prefer(&mut self, scheme: Scheme) {
        let value = match scheme {
            Scheme::Light => "light",
            Scheme::Dark => "dark",
        };
        let feature = json!({ "name": "prefers-color-scheme", "value": value });
        self.call(
            "Emulation.setEmulatedMedia",
            &json!({ "features": [feature] }),
        );
    }

    /// Returns the number of pixels by which the page is wider than the window.
    #[track_caller]
    pub(crate) fn overflow(&mut self) -> f64 {
        self.number(
            "Math.max(document.documentElement.scrollWidth, document.body.scrollWidth)
             - document.documentElement.clientWidth",
        )
    }

    /// Takes a picture of what is seen, leaves it as `picture`, and says what it looks like.
    #[track_caller]
    pub(crate) fn look(&mut self, picture: &Path) -> Look {
        let shot = self.call("Page.captureScreenshot", &json!({ "format": "png" }));
        let png = shot["data"].as_str().unwrap();
        let bytes = data_encoding::BASE64.decode(png.as_bytes()).unwrap();
        std::fs::write(picture, bytes).unwrap();
        let look = self.eval(&format!(
            "(async () => {{
               const bytes = Uint8Array.from(atob('{png}'), letter => letter.charCodeAt(0));
               const image = await createImageBitmap(new Blob([bytes]));
               const canvas = new OffscreenCanvas(image.width, image.height);
               const context = canvas.getContext('2d');
               context.drawImage(image, 0, 0);
               const pixels = context.getImageData(0, 0, image.width, image.height).data;
               const counts = new Map();
               let sum = 0;
               for (let i = 0; i < pixels.length; i += 4) {{
                 const colour = (pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2];
                 counts.set(colour, (counts.get(colour) || 0) + 1);
                 sum += pixels[i] + pixels[i + 1] + pixels[i + 2];
               }}
               const all = pixels.length / 4;
               return [counts.size, Math.max(...counts.values()) / all, sum / (3 * 255 * all)];
             }})()"
        ));
        Look {
            colours: look[0].as_u64().unwrap(),
            ground: look[1].as_f64().unwrap(),
            lightness: look[2].as_f64().unwrap(),
        }
    }

    /// Checks that something is visible in the preferred colour scheme, and nothing beyond the edge
    /// of the window. Saves a picture of it in `folder`.
    #[track_caller]
    pub(crate) fn assert_seen(&mut self, folder: &Path, scheme: Scheme, width: u32) {
        let picture = folder.join(format!("{scheme:?}-{width}.png").to_lowercase());
        let look = self.look(&picture);
        let seen = format!("{}: {look:?}", picture.display());
        assert!(look.colours > 50 && look.ground < 0.98, "{seen}");
        match scheme {
            Scheme::Light => assert!(look.lightness > 0.7, "{seen}"),
            Scheme::Dark => assert!(look.lightness < 0.4, "{seen}"),
        }
        assert!(self.overflow() <= 0.0, "{seen}: scrolls sideways");
    }

    /// Checks that the page as it stands has no faults in dark and light, on a desktop and on a
    /// phone, and saves pictures of it in `folder`.
    #[track_caller]
    pub(crate) fn assert_seen_everywhere(&mut self, folder: &Path, name: &str) {
        for (width, height) in [(1280, 800), (390, 844)] {
            self.resize(width, height);
            for scheme in [Scheme::Light, Scheme::Dark] {
                self.prefer(scheme);
                let theme = format!("{scheme:?}").to_lowercase();
                self.until(&format!(
                    "document.documentElement.dataset.theme === '{theme}'"
                ));
                self.eval(
                    "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))",
                );
                let seen = format!("{name}-{theme}-{width}");
                let faults = self.eval(include_str!("inspect.js"));
                assert_eq!(faults.as_array().map(Vec::len), Some(0), "{seen}: {faults}");
                self.look(&folder.join(format!("{seen}.png")));
                assert!(self.overflow() <= 0.0, "{seen}");
            }
        }
    }

    /// Returns the page's errors and warnings so far, and its requests to the network.
    pub(crate) fn complaints(&self) -> Vec<String> {
        let events = self.devtools.events();
        events.iter().filter_map(complaint).collect()
    }

    /// Asks that there is nothing to complain about.
    #[track_caller]
    pub(crate) fn assert_content(&self) {
        let complaints = self.complaints();
        assert!(complaints.is_empty(), "{complaints:#?}");
    }
}

/// Returns the complaint that an event is about a page, or `None` if it is harmless.
fn complaint(event: &Value) -> Option<String> {
    let params = &event["params"];
    let wrong = match event["method"].as_str()? {
        "Runtime.exceptionThrown" => true,
        "Runtime.consoleAPICalled" => {
            matches!(
                params["type"].as_str(),
                Some("error" | "warning" | "assert")
            )
        }
        "Log.entryAdded" => {
            matches!(params["entry"]["level"].as_str(), Some("error" | "warning"))
        }
        "Network.requestWillBeSent" => {
            let url = params["request"]["url"].as_str()?;
            !["file:", "data:", "blob:", "about:"]
                .iter()
                .any(|own| url.starts_with(own))
        }
        _ => false,
    };
    wrong.then(|| params.to_string())
}
