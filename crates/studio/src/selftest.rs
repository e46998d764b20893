//! The studio against itself: one of each kind is made, changed, run and shown over its own server, as a browser would ask for it.

use crate::{Settings, Studio};
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

/// Longest time of one of them, s.
const PATIENCE: f64 = 300.0;

/// Kind of its starting file, name, task, and the values that it gets.
type Case<'a> = (&'a str, &'a str, &'a str, &'a [(&'a str, &'a str)]);

/// Machine with a case, of one cheap level, and limits.
const QUALIFICATION: &str = r#"format = "auxbear.study/1"
scenario = "cases.toml"
set = ["run.accuracy=screening"]
seed = 1

[design]
kind = "qualification"
draws = 1

[[input]]
path = "contact.friction_coefficient"
uniform = [0.1, 0.2]

[[limit]]
quantity = "*.peak_contact_force"
most = "50 kN"
"#;

/// Makes and runs one of each kind in a folder, which is empty before; a line for each.
///
/// # Errors
/// What did not come out as it should.
pub fn run(folder: &Path, say: &mut dyn FnMut(&str)) -> Result<(), String> {
    let settings = Settings {
        folder,
        port: None,
        say: Box::new(|_| {}),
        date: || "2000-01-01".to_string(),
    };
    let studio = Studio::open(settings).map_err(|problem| problem.to_string())?;
    thread::scope(|scope| {
        scope.spawn(|| studio.serve());
        let done = each(&studio, say);
        studio.end();
        done
    })
}

fn each(studio: &Studio, say: &mut dyn FnMut(&str)) -> Result<(), String> {
    let begin = Instant::now();
    let stranger = Client {
        address: studio.plain_address(),
        cookie: String::new(),
    };
    if stranger.get("api/state").0 != 403 {
        return Err("a browser without the token was let in".to_string());
    }
    let client = Client::of(studio)?;
    let page = client.get("").1;
    if !page.contains("studio.js") {
        return Err("the first page is none".to_string());
    }
    say(&format!("page: {:.2} s", begin.elapsed().as_secs_f64()));
    let short = [("run.duration", "12 ms")];
    let shock = [
        ("run.duration", "12 ms"),
        ("base.case", "shock"),
        ("base.shock_y", "20 m/s^2"),
        ("base.shock_duration", "5 ms"),
    ];
    let quick = [("analysis.speed_count", "11")];
    let cases: [Case; 5] = [
        ("drop", "drop", "run", &short),
        ("machine", "cases", "run", &shock),
        ("rotor", "rotor", "run", &quick),
        ("study", "study", "study", &[("design.members", "4")]),
        ("", "qualification", "qualify", &[]),
    ];
    for (kind, name, task, changes) in cases {
        let begin = Instant::now();
        let file = format!("{name}.toml");
        let named = |why: String| format!("{name}: {why}");
        match kind {
            "" => drop(
                client
                    .post("api/save", &json!({ "name": file, "text": QUALIFICATION }))
                    .map_err(named)?,
            ),
            _ => drop(
                client
                    .post("api/new", &json!({ "kind": kind, "name": name }))
                    .map_err(named)?,
            ),
        }
        for (path, value) in changes {
            client.change(&file, kind, path, value).map_err(named)?;
        }
        let done = client.run(&file, task).map_err(named)?;
        let directory = done["directory"].as_str().unwrap_or_default();
        let (status, page) = client.get(&format!("page/run?run={directory}"));
        if status != 200 || !page.contains("</html>") {
            return Err(named(format!("its page is not there: status {status}")));
        }
        say(&format!(
            "{task} {file}: {:.1} s, {}",
            begin.elapsed().as_secs_f64(),
            done["words"].as_str().unwrap_or_default()
        ));
    }
    let (_, table) = client.get("api/runs");
    let table: Value = serde_json::from_str(&table).map_err(|error| error.to_string())?;
    match table["rows"].as_array().map_or(0, Vec::len) {
        rows if rows == cases.len() => Ok(()),
        rows => Err(format!("the table has {rows} runs of {}", cases.len())),
    }
}

/// Asks a studio as its own page does.
pub(crate) struct Client {
    pub address: String,
    pub cookie: String,
}

impl Client {
    /// Enters by the first address.
    pub fn of(studio: &Studio) -> Result<Client, String> {
        let address = studio.plain_address();
        let mut client = Client {
            address,
            cookie: String::new(),
        };
        let first = studio.address();
        let query = first.rsplit('/').next().unwrap_or_default();
        let (head, _) = client.exchange(
            &format!(
                "GET /{query} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
                client.host()
            ),
            "",
        )?;
        let line = head
            .lines()
            .find_map(|line| line.strip_prefix("Set-Cookie: "));
        let cookie = line
            .and_then(|line| line.split(';').next())
            .ok_or("the first address gives no cookie")?;
        client.cookie = cookie.to_string();
        Ok(client)
    }

    pub fn host(&self) -> String {
        self.address
            .trim_start_matches("http://")
            .trim_end_matches('/')
            .to_string()
    }

    /// Head and body of the answer to a request.
    pub fn exchange(&self, head: &str, body: &str) -> Result<(String, String), String> {
        let named = |error: std::io::Error| error.to_string();
        let mut stream = TcpStream::connect(self.host()).map_err(named)?;
        stream
            .write_all(format!("{head}{body}").as_bytes())
            .map_err(named)?;
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).map_err(named)?;
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap_or((&answer, ""));
        Ok((head.to_string(), body.to_string()))
    }

    /// Status and body.
    pub fn get(&self, path: &str) -> (u16, String) {
        let head = format!(
            "GET /{path} HTTP/1.1\r\nHost: {}\r\nCookie: {}\r\nConnection: close\r\n\r\n",
            self.host(),
            self.cookie
        );
        match self.exchange(&head, "") {
            Ok((head, body)) => (status(&head), body),
            Err(why) => (0, why),
        }
    }

    /// What a change gives.
    pub fn post(&self, path: &str, body: &Value) -> Result<Value, String> {
        let body = body.to_string();
        let host = self.host();
        let head = format!(
            "POST /{path} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nCookie: {}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
            self.cookie,
            body.len()
        );
        let (head, body) = self.exchange(&head, &body)?;
        let found: Value =
            serde_json::from_str(&body).map_err(|error| format!("{head}: {error}"))?;
        match status(&head) {
            200 => Ok(found),
            _ => Err(found["error"].as_str().unwrap_or(&head).to_string()),
        }
    }

    fn text(&self, name: &str) -> Result<(String, Value), String> {
        let (_, found) = self.get(&format!("api/file?name={name}"));
        let found: Value = serde_json::from_str(&found).map_err(|error| error.to_string())?;
        Ok((
            found["text"].as_str().unwrap_or_default().to_string(),
            found["hash"].clone(),
        ))
    }

    /// Sets a value in a file and saves it; a mistake in it is an error.
    pub fn change(&self, name: &str, kind: &str, path: &str, value: &str) -> Result<(), String> {
        let (text, hash) = self.text(name)?;
        let steps = crate::edit::steps(path);
        let set = self.post(
            "api/set",
            &json!({ "text": text, "kind": kind, "path": steps, "value": value }),
        )?;
        let found = self.post("api/check", &json!({ "name": name, "text": set["text"] }))?;
        if let Some(message) = found["syntax"]["message"].as_str() {
            return Err(message.to_string());
        }
        self.post(
            "api/save",
            &json!({ "name": name, "text": set["text"], "hash": hash }),
        )?;
        Ok(())
    }

    /// Runs a file and waits for its end.
    pub fn run(&self, name: &str, task: &str) -> Result<Value, String> {
        let id = self.post("api/run", &json!({ "name": name, "task": task }))?["id"].clone();
        let done = self.wait(&id, &["done", "failed", "stopped"])?;
        match done["state"] == "done" {
            true => Ok(done),
            false => Err(done["words"].as_str().unwrap_or("it failed").to_string()),
        }
    }

    /// Waits until a job is in one of these states.
    pub fn wait(&self, id: &Value, states: &[&str]) -> Result<Value, String> {
        let begin = Instant::now();
        while begin.elapsed().as_secs_f64() < PATIENCE {
            let (_, found) = self.get("api/state");
            let found: Value = serde_json::from_str(&found).map_err(|error| error.to_string())?;
            let jobs = found["jobs"].as_array().into_iter().flatten();
            let mut own = jobs.filter(|job| job["id"] == *id);
            if let Some(job) = own.next()
                && states.iter().any(|state| job["state"] == *state)
            {
                return Ok(job.clone());
            }
            thread::sleep(Duration::from_millis(20));
        }
        Err(format!("nothing came of it in {PATIENCE} s"))
    }
}

/// Status of an answer.
pub(crate) fn status(head: &str) -> u16 {
    head.split(' ')
        .nth(1)
        .and_then(|word| word.parse().ok())
        .unwrap_or(0)
}
