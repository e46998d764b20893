//! The server as browsers and strangers ask it.

use crate::selftest::{Client, status};
use crate::{Latest, Settings, Studio};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

fn open(folder: &Path, port: Option<u16>) -> Result<Studio, Box<auxbear::Problem>> {
    Studio::open(Settings {
        folder,
        port,
        say: Box::new(|_| {}),
        date: || "2000-01-01".to_string(),
    })
}

/// Serves a folder of its own while something is asked of it.
fn served(ask: impl FnOnce(&Client, &Path)) {
    let place = tempfile::tempdir().unwrap();
    let studio = open(place.path(), None).unwrap();
    thread::scope(|scope| {
        scope.spawn(|| studio.serve());
        let client = Client::of(&studio).unwrap();
        // the server ends also where a test fails
        let asked =
            std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| ask(&client, place.path())));
        studio.end();
        if let Err(panic) = asked {
            std::panic::resume_unwind(panic);
        }
    });
}

fn read(client: &Client, path: &str) -> Value {
    serde_json::from_str(&client.get(path).1).unwrap()
}

#[test]
fn strangers_are_refused() {
    served(|client, _| {
        let (host, cookie) = (client.host(), client.cookie.clone());
        let asked = |line: &str, headers: &[&str]| {
            let headers = headers.join("\r\n");
            let head = format!("{line} HTTP/1.1\r\n{headers}\r\nConnection: close\r\n\r\n");
            status(&client.exchange(&head, "").unwrap().0)
        };
        let [own_host, own_cookie] = [format!("Host: {host}"), format!("Cookie: {cookie}")];
        let origin = format!("Origin: http://{host}");
        assert_eq!(asked("GET /", &[&own_host, &own_cookie]), 200);
        // no cookie, a wrong one, a wrong token
        assert_eq!(asked("GET /", &[&own_host]), 403);
        assert_eq!(asked("GET /", &[&own_host, &format!("{own_cookie}0")]), 403);
        assert_eq!(asked("GET /?token=0", &[&own_host]), 403);
        // a name that leads here, and a page of another site
        assert_eq!(asked("GET /", &["Host: evil.example", &own_cookie]), 403);
        assert_eq!(
            asked(
                "GET /api/state",
                &[&own_host, &own_cookie, "Origin: http://evil.example"]
            ),
            403
        );
        assert_eq!(
            asked("GET /api/state", &[&own_host, &own_cookie, "Origin: null"]),
            403
        );
        // a change without an origin, or of another kind
        assert_eq!(
            asked(
                "POST /api/run",
                &[&own_host, &own_cookie, "Content-Length: 0"]
            ),
            403
        );
        assert_eq!(
            asked("DELETE /api/run", &[&own_host, &own_cookie, &origin]),
            405
        );
        assert_eq!(
            asked(
                "POST /api/run",
                &[&own_host, &own_cookie, &origin, "Content-Length: 0"]
            ),
            400
        );
    });
}

#[test]
fn every_answer_carries_its_rules_and_nothing_leads_out() {
    served(|client, folder| {
        let head = |path: &str| {
            let head = format!(
                "GET /{path} HTTP/1.1\r\nHost: {}\r\nCookie: {}\r\nConnection: close\r\n\r\n",
                client.host(),
                client.cookie
            );
            client.exchange(&head, "").unwrap().0
        };
        for path in [
            "",
            "studio.js",
            "studio.css",
            "figures.js",
            "api/state",
            "nothing",
        ] {
            let head = head(path);
            assert!(
                head.contains("default-src 'none'; script-src 'self'"),
                "{path}: {head}"
            );
            assert!(
                head.contains("nosniff") && !head.contains("unsafe"),
                "{path}: {head}"
            );
        }
        std::fs::create_dir_all(folder.join("runs/own")).unwrap();
        std::fs::write(
            folder.join("runs/own/report.html"),
            "<html><body>own</body></html>",
        )
        .unwrap();
        std::fs::write(
            folder.parent().unwrap().join("auxbear-studio-secret.toml"),
            "",
        )
        .unwrap();
        let page = head("page/run?run=runs/own");
        assert!(
            page.contains("sandbox allow-scripts") && !page.contains("allow-same-origin"),
            "{page}"
        );
        for path in [
            "page/run?run=..&file=auxbear-studio-secret.toml",
            "file?run=runs/own&file=../../../auxbear-studio-secret.toml",
            "api/file?name=../auxbear-studio-secret.toml",
            "api/file?name=%2e%2e%2fauxbear-studio-secret.toml",
            "file?run=/etc&file=passwd",
        ] {
            assert_eq!(client.get(path).0, 404, "{path}");
        }
        std::fs::remove_file(folder.parent().unwrap().join("auxbear-studio-secret.toml")).unwrap();
    });
}

#[test]
fn a_port_that_is_taken_and_a_folder_that_is_none_are_said() {
    let place = tempfile::tempdir().unwrap();
    let first = open(place.path(), None).unwrap();
    let other = tempfile::tempdir().unwrap();
    let busy = open(other.path(), Some(first.port))
        .err()
        .unwrap()
        .to_string();
    assert!(busy.contains("AB0309") && busy.contains("--port"), "{busy}");
    let second = open(place.path(), None).err().unwrap().to_string();
    assert!(
        second.contains("AB0308") && second.contains(&first.plain_address()),
        "{second}"
    );
    let file = place.path().join("file");
    std::fs::write(&file, "").unwrap();
    let none = open(&file, None).err().unwrap().to_string();
    assert!(none.contains("AB0307") && none.contains("a file"), "{none}");
    assert!(open(&file.join("below"), None).is_err());
}

#[test]
fn a_mistake_is_named_at_its_key_in_the_words_of_the_program() {
    served(|client, _| {
        client
            .post("api/new", &json!({ "kind": "drop", "name": "" }))
            .unwrap();
        let (_, found) = client.get("api/file?name=drop.toml");
        let text = serde_json::from_str::<Value>(&found).unwrap()["text"]
            .as_str()
            .unwrap()
            .to_string();
        let check = |text: &str| {
            client
                .post("api/check", &json!({ "name": "drop.toml", "text": text }))
                .unwrap()
        };
        let good = check(&text);
        assert_eq!(good["kind"], "drop");
        assert!(good["problem"].is_null() && good["values"].as_array().unwrap().len() > 60);
        let wrong = check(&text.replace("mass = \"8 kg\"", "mass = \"8 m\""));
        assert_eq!(wrong["problem"]["key"], "rotor.mass");
        let message = wrong["problem"]["message"].as_str().unwrap();
        assert!(
            message.starts_with("error[AB")
                && message.contains("drop.toml:")
                && message.contains("a mass above 0 is needed"),
            "{message}"
        );
        assert!(wrong["problem"]["line"].as_u64().unwrap() > 1);
        let broken = check(&text.replace("mass = \"8 kg\"", "mass = \"8 kg"));
        assert_eq!(broken["syntax"]["line"], wrong["problem"]["line"]);
        // what only building finds
        let fast = text.replace("speed = \"12000 rpm\"", "speed = \"60000 rpm\"");
        let build = client
            .post("api/build", &json!({ "name": "drop.toml", "text": fast }))
            .unwrap();
        assert!(build["warnings"][0].as_str().unwrap().starts_with("AB1015"));
    });
}

#[test]
fn a_shaft_and_its_closed_loop_are_drawn_from_the_text() {
    let scenario = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenarios/rotor_levitated.toml"
    );
    let text = std::fs::read_to_string(scenario).unwrap();
    served(|client, _| {
        let body = json!({ "name": "rotor.toml", "text": text });
        let found = client.post("api/check", &body).unwrap();
        let drawing: Value = serde_json::from_str(found["drawing"].as_str().unwrap()).unwrap();
        let summary: Value = serde_json::from_str(drawing["summary"].as_str().unwrap()).unwrap();
        let mut results = summary["quantities"].as_object().unwrap().values();
        let starts = results
            .find(|own| own["shown"]["pieces"] == "start")
            .unwrap();
        assert!(starts["value"].as_array().unwrap().len() > 3);
        let found = client.post("api/analysis", &body).unwrap();
        let run: Value = serde_json::from_str(found["run"].as_str().unwrap()).unwrap();
        let summary = run["summary"].as_str().unwrap();
        assert!(summary.contains(".rated.sensitivity\""));
        let none = client
            .post(
                "api/analysis",
                &json!({ "name": "drop.toml", "text": auxbear::template("drop") }),
            )
            .unwrap();
        assert_eq!(none["none"], true);
    });
}

#[test]
fn a_run_is_stopped_and_keeps_what_it_has_and_the_queue_goes_on() {
    served(|client, folder| {
        client
            .post("api/new", &json!({ "kind": "drop", "name": "long" }))
            .unwrap();
        client
            .post("api/new", &json!({ "kind": "drop", "name": "short" }))
            .unwrap();
        client
            .change("long.toml", "drop", "run.duration", "60 s")
            .unwrap();
        client
            .change("long.toml", "drop", "run.output_interval", "1 ms")
            .unwrap();
        client
            .change("short.toml", "drop", "run.duration", "12 ms")
            .unwrap();
        let add = |name: &str| {
            client
                .post("api/run", &json!({ "name": name, "task": "run" }))
                .unwrap()["id"]
                .clone()
        };
        let [long, short, never] = [add("long.toml"), add("short.toml"), add("short.toml")];
        client.post("api/stop", &json!({ "id": never })).unwrap();
        // its motion is shown while it is computed
        let mut live = Value::Null;
        while live["next"].as_u64().unwrap_or(0) < 60 {
            thread::sleep(Duration::from_millis(20));
            live = read(client, &format!("api/live?id={long}&round=0&from=0"));
        }
        let bearing = &live["bearings"][0];
        assert_eq!(
            bearing["path"].as_array().unwrap().len() as u64,
            live["next"].as_u64().unwrap()
        );
        assert!(
            bearing["balls"].as_array().unwrap().len() > 5
                && bearing["clearance"].as_f64().unwrap() > 0.0
        );
        client.post("api/stop", &json!({ "id": long })).unwrap();
        let stopped = client.wait(&long, &["stopped", "done", "failed"]).unwrap();
        assert_eq!(stopped["state"], "stopped");
        assert_eq!(
            client.wait(&short, &["done", "failed"]).unwrap()["state"],
            "done"
        );
        assert_eq!(
            client.wait(&never, &["stopped"]).unwrap()["directory"],
            Value::Null
        );
        assert!(folder.join("runs/long/history.parquet").exists());
        let table = read(client, "api/runs");
        let row = |name: &str| {
            let rows = table["rows"].as_array().unwrap().iter();
            rows.clone()
                .find(|row| row["directory"] == name)
                .unwrap()
                .clone()
        };
        assert_eq!(row("runs/long")["complete"], false);
        assert_eq!(row("runs/short")["differs"], json!([]));
        assert!(
            table["inputs"]
                .as_array()
                .unwrap()
                .contains(&json!("run.duration"))
        );
        // what is changed afterwards makes its run stale
        client
            .change("short.toml", "drop", "rotor.mass", "9 kg")
            .unwrap();
        let table = read(client, "api/runs");
        let rows = table["rows"].as_array().unwrap();
        let short = rows
            .iter()
            .find(|row| row["directory"] == "runs/short")
            .unwrap();
        assert_eq!(short["differs"], json!([["rotor.mass", "8 kg", "9 kg"]]));
        let compared = client.get("page/compare?run=runs/long&run=runs/short");
        assert!(compared.0 == 200 && compared.1.matches("class=\"run\"").count() >= 2);
    });
}

#[test]
fn a_study_is_stale_once_its_scenario_changes_and_then_begins_anew() {
    served(|client, folder| {
        client
            .post("api/new", &json!({ "kind": "study", "name": "many" }))
            .unwrap();
        client
            .change("drop.toml", "drop", "run.duration", "8 ms")
            .unwrap();
        client
            .change("many.toml", "study", "design.members", "2")
            .unwrap();
        let differs = || {
            let table = read(client, "api/runs");
            let rows = table["rows"].as_array().unwrap();
            rows.iter()
                .find(|row| row["directory"] == "runs/many")
                .unwrap()["differs"]
                .clone()
        };
        client.run("many.toml", "study").unwrap();
        assert_eq!(differs(), json!([]));
        // the same study goes on where it is
        assert_eq!(
            client.run("many.toml", "study").unwrap()["directory"],
            "runs/many"
        );
        client
            .change("drop.toml", "drop", "rotor.mass", "9 kg")
            .unwrap();
        assert_eq!(differs()[0][0], "scenario");
        assert!(differs()[0][2].as_str().unwrap().contains("9 kg"));
        assert_eq!(
            client.run("many.toml", "study").unwrap()["directory"],
            "runs/many-2"
        );
        assert!(folder.join("runs/many-2/report.html").exists());
    });
}

#[test]
fn of_several_requests_the_last_counts() {
    let latest = Latest::default();
    let begun = AtomicBool::new(false);
    thread::scope(|scope| {
        let first = scope.spawn(|| {
            latest.compute(|interrupt| {
                begun.store(true, Ordering::Relaxed);
                while !interrupt.load(Ordering::Relaxed) {
                    thread::sleep(Duration::from_millis(1));
                }
            })
        });
        while !begun.load(Ordering::Relaxed) {
            thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(latest.compute(|_| 2), Some(2));
        assert_eq!(first.join().unwrap(), None);
    });
}
