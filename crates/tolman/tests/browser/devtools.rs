//! A chromium without a window, and its DevTools protocol: methods with answers, and events.
//! <https://chromedevtools.github.io/devtools-protocol/>

use core::sync::atomic::{AtomicU32, Ordering};
use core::time::Duration;
use std::io;
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use serde_json::{Value, json};
use tungstenite::{Message, WebSocket};

/// A browser that has not answered by then never will.
const PATIENCE: Duration = Duration::from_secs(30);

const SWITCHES: [&str; 10] = [
    "--headless",
    // A root without a sandbox, as in containers, does not make the test fail.
    "--no-sandbox",
    "--disable-gpu",
    // Nor is a small /dev/shm.
    "--disable-dev-shm-usage",
    // It is to ask nobody for anything.
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--remote-debugging-port=0",
];

/// A running browser. It ends with this.
#[derive(Debug)]
pub(crate) struct Devtools {
    browser: Child,
    profile: PathBuf,
    socket: WebSocket<TcpStream>,
    last_id: u64,
    /// Messages of the browser that answer no request, oldest first.
    events: Vec<Value>,
}

impl Devtools {
    /// Starts a chromium with a new profile, or `None` if it is not installed.
    pub(crate) fn start() -> Option<Self> {
        static PROFILES: AtomicU32 = AtomicU32::new(0);
        let number = PROFILES.fetch_add(1, Ordering::Relaxed);
        let name = format!("tolman-chromium-{}-{number}", std::process::id());
        let profile = std::env::temp_dir().join(name);
        let spawned = Command::new("chromium")
            .args(SWITCHES)
            .arg(format!("--user-data-dir={}", profile.display()))
            .arg("about:blank")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        let browser = match spawned {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
            spawned => spawned.unwrap(),
        };
        let (port, path) = address(&profile);
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let url = format!("ws://127.0.0.1:{port}{path}");
        let (socket, _) = tungstenite::client(url, stream).unwrap();
        Some(Self {
            browser,
            profile,
            socket,
            last_id: 0,
            events: Vec::new(),
        })
    }

    /// Calls a method, of a session if one is given, and returns its answer. Events that come
    /// before it are kept.
    #[track_caller]
    pub(crate) fn call(&mut self, session: Option<&str>, method: &str, params: &Value) -> Value {
        self.last_id += 1;
        let mut call = json!({ "id": self.last_id, "method": method, "params": params });
        if let Some(session) = session {
            call["sessionId"] = session.into();
        }
        self.socket.send(Message::text(call.to_string())).unwrap();
        loop {
            let mut message = self.receive();
            if message["id"] == self.last_id {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].take();
            }
            self.events.push(message);
        }
    }

    /// Waits for an event of this name and forgets it; events before it are kept.
    #[track_caller]
    pub(crate) fn wait_for(&mut self, event: &str) {
        loop {
            if let Some(index) = self.events.iter().position(|seen| seen["method"] == event) {
                self.events.remove(index);
                return;
            }
            let message = self.receive();
            self.events.push(message);
        }
    }

    /// Returns all events so far.
    pub(crate) fn events(&self) -> &[Value] {
        &self.events
    }

    #[track_caller]
    fn receive(&mut self) -> Value {
        loop {
            if let Message::Text(text) = self.socket.read().unwrap() {
                return serde_json::from_str(&text).unwrap();
            }
        }
    }
}

impl Drop for Devtools {
    fn drop(&mut self) {
        // It may have gone by itself; what is left of it is to go as well.
        let _ = self.socket.send(Message::text(
            json!({ "id": 0, "method": "Browser.close" }).to_string(),
        ));
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_secs(3)
            && self.browser.try_wait().is_ok_and(|ended| ended.is_none())
        {
            std::thread::sleep(Duration::from_millis(20));
        }
        let _ = self.browser.kill();
        let _ = self.browser.wait();
        let _ = std::fs::remove_dir_all(&self.profile);
    }
}

/// Returns the port and path that the browser writes into its profile once it listens.
#[track_caller]
fn address(profile: &std::path::Path) -> (u16, String) {
    let file = profile.join("DevToolsActivePort");
    let begun = Instant::now();
    loop {
        let text = std::fs::read_to_string(&file).unwrap_or_default();
        if let Some((port, path)) = text.split_once('\n') {
            return (port.parse().unwrap(), path.trim().to_owned());
        }
        assert!(begun.elapsed() < PATIENCE, "chromium does not start");
        std::thread::sleep(Duration::from_millis(20));
    }
}
