//! Debian's chromium, driven through its debugging pipe: real clicks, real keys, pictures.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use std::{fs, thread};

const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Words of the browser; it reads from descriptor 3 and writes to 4, which the shell makes of its own input and output.
const WORDS: &str = "--headless --no-sandbox --disable-gpu --hide-scrollbars --no-first-run --remote-debugging-pipe --disable-extensions --disable-background-networking";

/// Longest wait for something that is to be seen.
const PATIENCE: Duration = Duration::from_secs(40);

/// A browser with one page.
pub struct Browser {
    child: Child,
    input: ChildStdin,
    output: Receiver<Value>,
    number: u64,
    session: Option<String>,
    /// What the console had to say.
    pub faults: Vec<String>,
    /// Clicks that were made.
    pub clicks: usize,
    /// Fields that were filled in.
    pub fields: usize,
}

impl Browser {
    /// Starts one with its profile in a folder; none where there is no browser.
    pub fn start(profile: &Path) -> Option<Browser> {
        let known = |name: &&str| {
            Command::new(name)
                .arg("--version")
                .output()
                .is_ok_and(|found| found.status.success())
        };
        let name = BROWSERS.into_iter().find(known)?;
        let line = format!("exec {name} {WORDS} --user-data-dir=\"$0\" 3<&0 4>&1 1>&2");
        let mut child = Command::new("sh")
            .args(["-c", &line])
            .arg(profile)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let (sender, output) = channel();
        let mut message = BufReader::new(child.stdout.take().unwrap());
        thread::spawn(move || {
            let mut bytes = Vec::new();
            while message
                .read_until(0, &mut bytes)
                .is_ok_and(|count| count > 0)
            {
                bytes.pop();
                let value = serde_json::from_slice(&bytes);
                if value.is_ok_and(|value| sender.send(value).is_err()) {
                    return;
                }
                bytes.clear();
            }
        });
        let mut browser = Browser {
            input: child.stdin.take().unwrap(),
            output,
            child,
            number: 0,
            session: None,
            faults: Vec::new(),
            clicks: 0,
            fields: 0,
        };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        browser.attach(&target["targetId"]);
        for domain in ["Page", "Runtime", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser.size(1280, 850, false);
        Some(browser)
    }

    fn attach(&mut self, target: &Value) {
        self.session = None;
        let given = json!({ "targetId": target, "flatten": true });
        let found = self.asked("Target.attachToTarget", given, PATIENCE);
        self.session = found
            .ok()
            .and_then(|found| found["sessionId"].as_str().map(str::to_string));
    }

    /// Asks the browser, and takes note of faults that it reports meanwhile.
    pub fn call(&mut self, method: &str, given: Value) -> Value {
        self.asked(method, given, PATIENCE)
            .unwrap_or_else(|error| panic!("{method}: {error}"))
    }

    /// The same; an error where the page was just left, or does not answer in some time.
    fn asked(&mut self, method: &str, given: Value, patience: Duration) -> Result<Value, String> {
        self.number += 1;
        let mut asked = json!({ "id": self.number, "method": method, "params": given });
        if let Some(session) = &self.session {
            asked["sessionId"] = json!(session);
        }
        self.input
            .write_all(format!("{asked}\0").as_bytes())
            .unwrap();
        self.input.flush().unwrap();
        let begin = Instant::now();
        loop {
            let left = patience.saturating_sub(begin.elapsed());
            let message = self
                .output
                .recv_timeout(left)
                .map_err(|error| error.to_string())?;
            let is_fault = match message["method"].as_str() {
                Some("Runtime.exceptionThrown") => true,
                Some("Log.entryAdded") => message["params"]["entry"]["level"] == "error",
                _ => false,
            };
            if is_fault {
                self.faults.push(message["params"].to_string());
            }
            if message["id"] == self.number {
                return match message["error"].is_null() {
                    true => Ok(message["result"].clone()),
                    false => Err(message["error"].to_string()),
                };
            }
        }
    }

    /// Width and height, and whether the system prefers dark.
    pub fn size(&mut self, width: u32, height: u32, dark: bool) {
        let given = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600 });
        self.call("Emulation.setDeviceMetricsOverride", given);
        let scheme = if dark { "dark" } else { "light" };
        let given = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.call("Emulation.setEmulatedMedia", given);
    }

    /// Opens an address.
    pub fn open(&mut self, address: &str) {
        self.call("Page.navigate", json!({ "url": address }));
    }

    /// The value of an expression in the page.
    pub fn value(&mut self, expression: &str) -> Value {
        let given =
            json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let found = self.call("Runtime.evaluate", given);
        assert!(found["exceptionDetails"].is_null(), "{expression}: {found}");
        found["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub fn wait(&mut self, expression: &str) {
        let begin = Instant::now();
        let seen = format!(
            "(() => {{ try {{ return Boolean({expression}); }} catch {{ return false; }} }})()"
        );
        loop {
            let given = json!({ "expression": seen, "returnByValue": true });
            // a page that is just left has nothing to see
            let found = self.asked("Runtime.evaluate", given, Duration::from_secs(5));
            if found.is_ok_and(|found| found["result"]["value"] == true) {
                return;
            }
            let page = || "document.body.innerText.slice(0, 1500)";
            assert!(
                begin.elapsed() < PATIENCE,
                "not seen: {expression}\n{}\n{:?}",
                self.value(page()),
                self.faults
            );
            thread::sleep(Duration::from_millis(15));
        }
    }

    /// Middle of the first element of a selector that has these words, brought into view.
    fn place(&mut self, selector: &str, words: &str) -> [f64; 2] {
        let find = format!(
            "[...document.querySelectorAll({})].find((one) => one.textContent.includes({}) && one.getClientRects().length)",
            json!(selector),
            json!(words)
        );
        self.wait(&format!("{find} && !({find}).disabled"));
        let found = self.value(&format!("(() => {{ const one = {find}; one.scrollIntoView({{ block: 'center' }}); const box = one.getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; }})()"));
        [0, 1].map(|k| found[k].as_f64().unwrap())
    }

    /// Clicks the middle of the first element of a selector that has these words.
    pub fn click(&mut self, selector: &str, words: &str) {
        let [x, y] = self.place(selector, words);
        self.clicks += 1;
        for kind in ["mousePressed", "mouseReleased"] {
            let given = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", given);
        }
    }

    /// Replaces what stands in a field by what is typed.
    pub fn fill(&mut self, selector: &str, text: &str) {
        self.wait(&format!("document.querySelector({})", json!(selector)));
        self.value(&format!("(() => {{ const one = document.querySelector({}); const box = one.closest('details'); if (box) box.open = true; one.scrollIntoView({{ block: 'center' }}); one.focus(); one.select(); }})()", json!(selector)));
        self.fields += 1;
        match text {
            "" => self.key("Delete", 46, 0),
            _ => drop(self.call("Input.insertText", json!({ "text": text }))),
        }
    }

    /// Presses a key; control is 2, shift 8.
    pub fn key(&mut self, key: &str, code: u32, modifiers: u32) {
        for kind in ["rawKeyDown", "keyUp"] {
            let given = json!({ "type": kind, "key": key, "windowsVirtualKeyCode": code, "modifiers": modifiers });
            self.call("Input.dispatchKeyEvent", given);
        }
        if key == "Enter" && modifiers == 0 {
            self.call(
                "Input.dispatchKeyEvent",
                json!({ "type": "char", "key": key, "text": "\r" }),
            );
        }
    }

    /// The value of an expression in the frame of the page, which has an origin of its own.
    pub fn in_frame(&mut self, expression: &str) -> Value {
        let own = self.session.clone();
        let begin = Instant::now();
        loop {
            self.session = None;
            let targets = self.call("Target.getTargets", json!({}));
            let frame = targets["targetInfos"]
                .as_array()
                .unwrap()
                .iter()
                .find(|one| one["type"] == "iframe")
                .cloned();
            if let Some(frame) = frame {
                self.attach(&frame["targetId"]);
                let given = json!({ "expression": expression, "returnByValue": true });
                // a frame that is just left does not answer
                let found = self.asked("Runtime.evaluate", given, Duration::from_secs(2));
                let found = found.map_or(Value::Null, |found| found["result"]["value"].clone());
                if !found.is_null() && found != json!(0) && found != json!(false) {
                    self.session = own;
                    return found;
                }
            }
            self.session.clone_from(&own);
            assert!(begin.elapsed() < PATIENCE, "not in the frame: {expression}");
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// A picture of the page as a WebP file.
    pub fn picture(&mut self, file: &Path) {
        let found = self.call(
            "Page.captureScreenshot",
            json!({ "format": "webp", "quality": 82 }),
        );
        fs::write(file, decoded(found["data"].as_str().unwrap())).unwrap();
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Bytes of a base64 text.
fn decoded(text: &str) -> Vec<u8> {
    let value = |byte: u8| match byte {
        b'A'..=b'Z' => byte - b'A',
        b'a'..=b'z' => byte - b'a' + 26,
        b'0'..=b'9' => byte - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for four in text.trim_end_matches('=').as_bytes().chunks(4) {
        let all = four.iter().enumerate().fold(0u32, |all, (k, byte)| {
            all | (u32::from(value(*byte)) << (18 - 6 * k))
        });
        bytes.extend_from_slice(&all.to_be_bytes()[1..four.len()]);
    }
    bytes
}
