//! The server: who may ask, what each address gives, and the rules that a browser follows with it.
//!
//! It listens on the loopback address alone. The first address carries a token, which becomes a cookie that no other site's page can
//! make a browser send; the names of the host and of the origin are compared, so that no name that leads here and no foreign page does.

use crate::Studio;
use std::io::{Read, Write};
use tiny_http::{Header, Method, Request, Response};

/// Most bytes of a request's body.
const MOST_BYTES: u64 = 8 << 20;

/// The rules of the studio's own pages: nothing from outside, no script or style inside the markup.
const OWN_RULES: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// The rules of pages that runs left: one file with its scripts, in a frame that has no origin and reaches nothing.
const PAGE_RULES: &str = "sandbox allow-scripts allow-modals; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'";

/// What is answered.
pub struct Reply {
    /// Status of the answer.
    pub status: u16,
    kind: &'static str,
    /// Its content.
    pub body: Vec<u8>,
    rules: &'static str,
    more: Vec<(&'static str, String)>,
}

impl Reply {
    /// A text or file of the studio itself.
    pub fn own(kind: &'static str, body: impl Into<Vec<u8>>) -> Reply {
        Reply {
            status: 200,
            kind,
            body: body.into(),
            rules: OWN_RULES,
            more: Vec::new(),
        }
    }

    /// Data.
    pub fn json(value: &serde_json::Value) -> Reply {
        Reply::own("application/json", value.to_string())
    }

    /// A page that a run left, for a frame.
    pub fn page(html: impl Into<Vec<u8>>) -> Reply {
        Reply {
            rules: PAGE_RULES,
            ..Reply::own("text/html; charset=utf-8", html)
        }
    }

    /// A file to be kept.
    pub fn download(name: &str, body: Vec<u8>) -> Reply {
        let plain = |c: char| {
            if c.is_ascii_alphanumeric() || "._-".contains(c) {
                c
            } else {
                '_'
            }
        };
        let name: String = name.chars().map(plain).collect();
        let mut reply = Reply::own("application/octet-stream", body);
        reply.more.push((
            "Content-Disposition",
            format!("attachment; filename=\"{name}\""),
        ));
        reply
    }

    /// A refusal with its reason.
    pub fn refused(status: u16, why: &str) -> Reply {
        Reply {
            status,
            ..Reply::json(&serde_json::json!({ "error": why }))
        }
    }
}

/// What is asked.
pub struct Call<'a> {
    /// The path without its query.
    pub path: &'a str,
    /// Whether something may change.
    pub changes: bool,
    query: Vec<(String, String)>,
    /// The body of what changes something.
    pub body: serde_json::Value,
}

impl Call<'_> {
    /// The first value of a name in the query.
    pub fn get(&self, name: &str) -> Option<&str> {
        let mut own = self.query.iter().filter(|(known, _)| known == name);
        own.next().map(|(_, value)| value.as_str())
    }

    /// All values of a name in the query.
    pub fn all<'q>(&'q self, name: &'q str) -> impl Iterator<Item = &'q str> {
        let own = self.query.iter().filter(move |(known, _)| known == name);
        own.map(|(_, value)| value.as_str())
    }

    /// A text of the body; empty where there is none.
    pub fn text(&self, name: &str) -> &str {
        self.body[name].as_str().unwrap_or_default()
    }
}

/// Answers a request.
pub fn answer(studio: &Studio, mut request: Request) {
    let reply = reply(studio, &mut request);
    let mut response = Response::from_data(reply.body)
        .with_status_code(reply.status)
        .with_chunked_threshold(usize::MAX);
    let fixed = [
        ("Content-Type", reply.kind),
        ("Content-Security-Policy", reply.rules),
        ("X-Content-Type-Options", "nosniff"),
        ("Referrer-Policy", "no-referrer"),
        ("Cache-Control", "no-store"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
    ];
    let more = reply
        .more
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    for (name, value) in fixed.into_iter().chain(more) {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    // in one piece: two would wait for each other, some 40 ms
    let mut bytes = Vec::new();
    let (version, head) = (
        request.http_version().clone(),
        *request.method() == Method::Head,
    );
    let printed = response.raw_print(&mut bytes, version, request.headers(), head, None);
    let mut writer = request.into_writer();
    // a browser that left needs no answer
    let _ = printed
        .and_then(|()| writer.write_all(&bytes))
        .and_then(|()| writer.flush());
}

fn header<'r>(request: &'r Request, name: &str) -> Option<&'r str> {
    let mut own = request
        .headers()
        .iter()
        .filter(|header| header.field.as_str().as_str().eq_ignore_ascii_case(name));
    own.next().map(|header| header.value.as_str())
}

fn reply(studio: &Studio, request: &mut Request) -> Reply {
    let host = header(request, "Host").unwrap_or_default().to_string();
    if !studio.hosts().contains(&host) {
        return Reply::refused(403, "this server answers to its own address alone");
    }
    let url = request.url().to_string();
    let (path, query) = url.split_once('?').unwrap_or((&url, ""));
    let query: Vec<(String, String)> = query
        .split('&')
        .filter(|pair| !pair.is_empty())
        .map(|pair| pair.split_once('=').unwrap_or((pair, "")))
        .map(|(name, value)| (plain(name), plain(value)))
        .collect();
    let changes = match request.method() {
        Method::Get | Method::Head => false,
        Method::Post => true,
        _ => return Reply::refused(405, "GET and POST are understood"),
    };
    if path == "/"
        && !changes
        && query
            .iter()
            .any(|(name, value)| name == "token" && same(value, studio.token()))
    {
        return entrance(studio);
    }
    let cookie = format!("{}={}", studio.cookie(), studio.token());
    let cookies = header(request, "Cookie").unwrap_or_default();
    if !cookies.split(';').any(|own| same(own.trim(), &cookie)) {
        return Reply::refused(
            403,
            "open the studio by the address that the terminal shows",
        );
    }
    let origin = header(request, "Origin");
    let own = format!("http://{host}");
    if origin.is_some_and(|origin| origin != own) || (changes && origin.is_none()) {
        return Reply::refused(
            403,
            "what changes something is accepted of the studio's own page alone",
        );
    }
    let mut body = serde_json::Value::Null;
    if changes {
        let mut text = Vec::new();
        let read = request.as_reader().take(MOST_BYTES).read_to_end(&mut text);
        match read.ok().and_then(|_| serde_json::from_slice(&text).ok()) {
            Some(read) => body = read,
            None => return Reply::refused(400, "JSON of at most 8 MB is needed"),
        }
    }
    crate::routes::route(
        studio,
        &Call {
            path,
            changes,
            query,
            body,
        },
    )
}

/// The page behind the first address: it gives the cookie and goes on by itself, so that the browser sends the cookie there whatever
/// page or program the first address was opened from.
fn entrance(studio: &Studio) -> Reply {
    let page = "<!doctype html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0;url=/\"><title>auxbear studio</title><a href=\"/\">auxbear studio</a>";
    let mut reply = Reply::own("text/html; charset=utf-8", page);
    let cookie = format!(
        "{}={}; Path=/; HttpOnly; SameSite=Strict",
        studio.cookie(),
        studio.token()
    );
    reply.more.push(("Set-Cookie", cookie));
    reply
}

/// Whether two texts are the same, in a time that does not depend on where they differ.
fn same(one: &str, other: &str) -> bool {
    let differences = one
        .bytes()
        .zip(other.bytes())
        .fold(0, |all, (a, b)| all | (a ^ b));
    one.len() == other.len() && differences == 0
}

/// A part of an address as text.
fn plain(coded: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = coded.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'+' => b' ',
            b'%' => {
                let digits: String = rest.by_ref().take(2).map(char::from).collect();
                u8::from_str_radix(&digits, 16).unwrap_or(b'?')
            }
            byte => byte,
        });
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_as_browsers_write_them() {
        assert_eq!(plain("a%2Fb+c%C3%A4"), "a/b cä");
        assert_eq!(plain("%"), "?");
    }

    #[test]
    fn texts_are_compared_whole() {
        assert!(same("abc", "abc") && !same("abc", "abd") && !same("abc", "ab") && !same("", "a"));
    }

    #[test]
    fn a_download_keeps_a_plain_name() {
        let reply = Reply::download("a\"b\r\nc.csv", Vec::new());
        assert_eq!(reply.more[0].1, "attachment; filename=\"a_b__c.csv\"");
    }
}
