//! The studio as a person meets it: in a browser, by clicks and keys. With AUXBEAR_STUDIO_PICTURES set to a folder, the pictures of the
//! guide are taken on the way.

use crate::browser::Browser;
use crate::place::Place;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, thread};

/// A studio that runs, with a browser on it.
struct Session {
    place: Place,
    studio: Child,
    browser: Browser,
    address: String,
}

impl Session {
    /// None where there is no browser.
    fn begin() -> Option<Session> {
        let place = Place::new();
        let folder = place.path("machines");
        let browser = Browser::start(&place.path("profile"));
        let Some(mut browser) = browser else {
            eprintln!("no browser: the studio was not opened");
            return None;
        };
        let mut studio = place.command(&["studio", "machines", "--no-browser"]);
        let mut studio = studio
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut address = String::new();
        BufReader::new(studio.stdout.as_mut().unwrap())
            .read_line(&mut address)
            .unwrap();
        assert!(folder.is_dir());
        let address = address.trim().to_string();
        browser.open(&address);
        browser.wait("document.querySelector('#side .files')");
        Some(Session {
            place,
            studio,
            browser,
            address,
        })
    }

    fn file(&self, name: &str) -> PathBuf {
        self.place.path("machines").join(name)
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.file(name)).unwrap()
    }

    fn go(&mut self, view: &str) {
        self.browser.value(&format!("location.hash = '#/{view}'"));
    }

    fn saved(&mut self) {
        self.browser.key("s", 83, 2);
        self.browser.wait("document.querySelector('.status') && document.querySelector('.status').textContent === 'saved'");
    }

    /// A picture for the guide, where they are wanted.
    fn picture(&mut self, name: &str) {
        if let Some(folder) = env::var_os("AUXBEAR_STUDIO_PICTURES") {
            thread::sleep(Duration::from_millis(400));
            self.browser
                .picture(&PathBuf::from(folder).join(format!("studio_{name}.webp")));
        }
    }

    fn no_faults(&self) {
        assert!(self.browser.faults.is_empty(), "{:?}", self.browser.faults);
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let _ = self.studio.kill();
        let _ = self.studio.wait();
    }
}

const MASS: &str = "#field-rotor\\.mass";
const DURATION: &str = "#field-run\\.duration";

#[test]
fn from_an_empty_folder_to_a_finished_drop_and_on() {
    let Some(mut session) = Session::begin() else {
        return;
    };
    // a finished drop, in few clicks and fields
    session.browser.click("[data-kind=drop]", "drop");
    session
        .browser
        .wait("document.querySelector('.drawing svg')");
    session.browser.fill(DURATION, "30 ms");
    session.browser.click(".tasks .first", "Run");
    session.browser.click("a.button.first", "Results");
    let title = session.browser.in_frame("document.querySelector('h1') && document.querySelectorAll('section').length > 4 && document.querySelector('h1').textContent");
    assert!(
        title
            .as_str()
            .unwrap()
            .contains("Drop of a levitated rotor"),
        "{title}"
    );
    // one cursor over everything that moves
    let clicks_before = session.browser.clicks;
    session.browser.click(".tabs button", "Motion");
    session.browser.wait("document.querySelectorAll('.plots svg[role=img]').length >= 4 && document.querySelector('.live figcaption').textContent.includes('contact force 72')");
    session.picture("motion");
    session
        .browser
        .value("document.querySelector('.cursor input').focus()");
    session.browser.key("Home", 36, 0);
    session.browser.wait("document.querySelector('.cursor output').textContent.startsWith('0') && document.querySelector('.live figcaption').textContent.endsWith('force 0 N')");
    session.browser.clicks = clicks_before;
    let (clicks, fields) = (session.browser.clicks, session.browser.fields);
    assert!(
        clicks <= 8 && fields <= 3,
        "{clicks} clicks, {fields} fields"
    );
    assert!(session.file("runs/drop/summary.json").exists());
    assert!(
        session
            .text("drop.toml")
            .contains("\nduration = \"30 ms\"\n")
    );
    session.picture("run");

    // wrong input: the program's own message at the key, nothing saved over; taken back by undo
    session.go("edit/drop.toml");
    session.browser.fill(MASS, "8 m");
    session.browser.wait("document.querySelector('.field.wrong .fault').textContent.includes('a mass above 0 is needed')");
    session
        .browser
        .wait("document.querySelector('.gutter .wrong') && document.querySelector('.drawing.old')");
    session.picture("mistake");
    session.browser.key("z", 90, 2);
    session.browser.wait(
        "!document.querySelector('.field.wrong') && document.querySelector('.problem').hidden && document.getElementById('field-rotor.mass').value === '8 kg'",
    );

    // while the text is broken fields wait, and what is typed is kept
    let before = session
        .browser
        .value("document.querySelector('.toml').value");
    session.browser.value("(() => { const area = document.querySelector('.toml'); area.focus(); area.setSelectionRange(0, 0); })()");
    session
        .browser
        .call("Input.insertText", serde_json::json!({ "text": "[[\n" }));
    session.browser.wait("document.querySelector('.field.waits') && document.querySelector('.problem').textContent.includes('line 1')");
    session.browser.fill(MASS, "9 kg");
    thread::sleep(Duration::from_millis(150));
    assert_eq!(
        session
            .browser
            .value("document.getElementById('field-rotor.mass').value"),
        "9 kg"
    );
    session.browser.value("(() => { const area = document.querySelector('.toml'); area.focus(); area.setSelectionRange(0, 3); })()");
    session.browser.key("Delete", 46, 0);
    session
        .browser
        .wait("document.querySelector('.toml').value.includes('mass = \"9 kg\"')");
    let after = session
        .browser
        .value("document.querySelector('.toml').value");
    assert_eq!(
        after.as_str().unwrap(),
        before
            .as_str()
            .unwrap()
            .replace("mass = \"8 kg\"", "mass = \"9 kg\"")
    );
    session.saved();

    // from a key to the drawing
    let watch = "new Promise((done) => { setTimeout(() => done(1e9), 8000); const begin = performance.now(); new MutationObserver((_, own) => { if (document.querySelector('.drawing').textContent.includes('300 µm')) { own.disconnect(); done(performance.now() - begin); } }).observe(document.querySelector('.drawing'), { childList: true, subtree: true }); const field = document.querySelector('#field-contact\\\\.radial_air_clearance'); field.value = '0.3 mm'; field.dispatchEvent(new Event('input')); })";
    let times: f64 = session.browser.value(watch).as_f64().unwrap();
    eprintln!("from a key to the drawing: {times:.0} ms");
    assert!(times < 1e9, "the drawing does not follow");
    session.saved();

    // a long run: its motion is shown while it is computed; stopped it keeps what it has
    session.browser.fill(DURATION, "60 s");
    session
        .browser
        .wait("document.querySelector('.toml').value.includes('60 s')");
    session.browser.key("Enter", 13, 2);
    session.browser.wait("document.querySelector('.live canvas') && document.querySelector('.live .instant').textContent.includes('rotor')");
    session.picture("live");
    session.browser.click(".toolbar .stop", "Stop");
    session
        .browser
        .wait("document.querySelector('.toolbar .status').textContent === 'stopped'");
    assert!(session.file("runs/drop-2/summary.json").exists());

    // the table: what differs, what is stale; two of them side by side
    session.go("runs");
    session
        .browser
        .wait("document.querySelectorAll('.runs tbody tr').length === 2");
    let table = session
        .browser
        .value("document.querySelector('.runs table').innerText");
    let table = table.as_str().unwrap();
    for words in [
        "run.duration",
        "60 s",
        "30 ms",
        "stale",
        "not complete",
        "first impact force",
    ] {
        assert!(table.contains(words), "{words}: {table}");
    }
    session.picture("runs");
    session.browser.click("[aria-label='Choose runs/drop']", "");
    session
        .browser
        .click("[aria-label='Choose runs/drop-2']", "");
    session.browser.click(".toolbar .first", "Compare 2 runs");
    let differences = session.browser.in_frame("document.body.innerText.includes('run.duration') && document.querySelectorAll('section').length");
    assert!(differences.as_u64().unwrap() > 4);

    // an input named in the page of a run opens where it is changed
    session.go("run/runs/drop");
    session.browser.in_frame("document.readyState === 'complete' && location.href.includes('page/run') && (() => { const own = [...document.querySelectorAll('td, code')].find((one) => one.textContent.trim() === 'mount.stiffness'); if (own) own.click(); return Boolean(own); })()");
    session
        .browser
        .wait("document.activeElement.id === 'field-mount.stiffness'");
    session.no_faults();
}

#[test]
fn a_file_that_is_changed_outside_is_merged_or_asked_for() {
    let Some(mut session) = Session::begin() else {
        return;
    };
    session.browser.click("[data-kind=drop]", "drop");
    session
        .browser
        .wait("document.querySelector('.drawing svg')");
    let other = |session: &Session, from: &str, to: &str| {
        let text = session.text("drop.toml");
        assert!(text.contains(from));
        fs::write(session.file("drop.toml"), text.replace(from, to)).unwrap();
    };
    // nothing unsaved here: shown as it is
    other(&session, "speed = \"12000 rpm\"", "speed = \"9000 rpm\"");
    session
        .browser
        .wait("document.querySelector('.toml').value.includes('9000 rpm')");
    // other lines: both
    session.browser.fill(MASS, "7 kg");
    session
        .browser
        .wait("document.querySelector('.toml').value.includes('\"7 kg\"')");
    other(
        &session,
        "stiffness = \"1e6 N/m\"",
        "stiffness = \"2e6 N/m\"",
    );
    session.browser.wait("document.querySelector('.toml').value.includes('2e6 N/m') && document.querySelector('.toml').value.includes('\"7 kg\"')");
    session.saved();
    assert!(
        session.text("drop.toml").contains("7 kg") && session.text("drop.toml").contains("2e6 N/m")
    );
    // the same line: asked
    session.browser.fill(MASS, "6 kg");
    session
        .browser
        .wait("document.querySelector('.toml').value.includes('\"6 kg\"')");
    other(&session, "mass = \"7 kg\"", "mass = \"5 kg\"");
    session.browser.key("s", 83, 2);
    session
        .browser
        .wait("!document.querySelector('.asks').hidden");
    // saving again is no answer
    session.browser.key("s", 83, 2);
    session
        .browser
        .wait("document.getElementById('said').textContent.includes('choose first')");
    assert!(session.text("drop.toml").contains("mass = \"5 kg\""));
    session.browser.key("Escape", 27, 0);
    session.browser.click(".asks button", "Take theirs");
    session.browser.wait("document.getElementById('field-rotor.mass').value === '5 kg' && document.querySelector('.status').textContent === 'saved'");
    session.no_faults();
}

#[test]
fn small_and_dark_pages_by_keys_alone() {
    let Some(mut session) = Session::begin() else {
        return;
    };
    let begin = Instant::now();
    let address = session.address.clone();
    session.browser.open(&address);
    session
        .browser
        .wait("document.querySelector('[data-kind=machine]')");
    eprintln!("first page: {:.2} s", begin.elapsed().as_secs_f64());
    // the button of a kind is reached and pressed by keys
    for _ in 0..30 {
        session.browser.key("Tab", 9, 0);
        if session
            .browser
            .value("document.activeElement.dataset.kind || ''")
            == "machine"
        {
            break;
        }
    }
    session.browser.key("Enter", 13, 0);
    session
        .browser
        .wait("document.querySelector('.drawing svg.rotor')");
    session.picture("edit");
    session.browser.value("document.activeElement.blur()");
    session.browser.key("/", 191, 0);
    session
        .browser
        .wait("document.activeElement.classList.contains('filter')");
    session.browser.call(
        "Input.insertText",
        serde_json::json!({ "text": "friction_coeff" }),
    );
    session.browser.wait("[...document.querySelectorAll('.field')].filter((one) => one.getClientRects().length && one.dataset.path.includes('friction_coefficient')).length && ![...document.querySelectorAll('.section .field')].some((one) => one.getClientRects().length && one.dataset.path === 'rotor.speed')");
    session.browser.fill(".filter", "");
    // parts: a key of one, a new one, one taken away
    session
        .browser
        .fill("#field-rotor\\.disk\\.0\\.mass", "6 kg");
    session
        .browser
        .wait("document.querySelector('.toml').value.includes('mass = \"6 kg\"')");
    session
        .browser
        .click("details:has([data-path^='rotor.disk.']) .add", "disk");
    session
        .browser
        .wait("document.querySelector('#field-rotor\\\\.disk\\\\.1\\\\.mass')");
    session
        .browser
        .click("[aria-label^='Remove rotor.disk']", "×");
    session
        .browser
        .wait("!document.querySelector('#field-rotor\\\\.disk\\\\.1\\\\.mass')");
    session.saved();
    // no page is wider than its screen
    let mut wide = Vec::new();
    for (width, dark) in [(390, false), (390, true), (1280, true)] {
        session.browser.size(width, 850, dark);
        for view in ["edit/machine.toml", "runs", ""] {
            session.go(view);
            thread::sleep(Duration::from_millis(250));
            let own = session
                .browser
                .value("document.documentElement.scrollWidth")
                .as_u64()
                .unwrap();
            if own > u64::from(width) {
                wide.push(format!("{view} at {width}: {own}"));
            }
        }
        session.go("edit/machine.toml");
        session.picture(match (width, dark) {
            (390, true) => "small_dark",
            (390, false) => "small",
            _ => "dark",
        });
    }
    assert!(wide.is_empty(), "{wide:?}");
    let ground = session
        .browser
        .value("getComputedStyle(document.body).backgroundColor");
    assert_eq!(ground, "rgb(20, 26, 32)");
    session.no_faults();
}

#[test]
fn the_studio_tries_itself_and_says_what_is_wrong() {
    let place = Place::new();
    let tried = place.call(&["studio", "--selftest"]).done();
    for line in [
        "run drop.toml",
        "run cases.toml",
        "run rotor.toml",
        "study study.toml",
        "qualify qualification.toml",
        "the studio works",
    ] {
        assert!(tried.out.contains(line), "{line}: {}", tried.out);
    }
    let wrong = place.call(&["studio", "drop.toml"]);
    assert_eq!(wrong.code, Some(2));
    assert!(
        wrong.err.contains("error[AB0307]") && wrong.err.contains("drop.toml"),
        "{}",
        wrong.err
    );
}
