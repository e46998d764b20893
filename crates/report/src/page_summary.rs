//! The summary as the page carries it: of very many members the first, with how many there are.

use super::summary::OF_PAGE as MEMBER_LIMIT;
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A summary for the page; one that has few members, or cannot be read, as it is.
pub(super) fn for_page(summary: &str) -> Cow<'_, str> {
    thinned(summary).map_or(Cow::Borrowed(summary), Cow::Owned)
}

fn thinned(summary: &str) -> Option<String> {
    let mut parts: BTreeMap<String, &RawValue> = serde_json::from_str(summary).ok()?;
    let members: Vec<&RawValue> = serde_json::from_str(parts.get("members")?.get()).ok()?;
    let total = members.len();
    if total <= MEMBER_LIMIT {
        return None;
    }
    let first = |list: &[&RawValue]| {
        serde_json::value::to_raw_value(&list[..MEMBER_LIMIT.min(list.len())]).ok()
    };
    let members = first(&members)?;
    let drawn = match parts.get("drawn") {
        Some(drawn) => first(&serde_json::from_str::<Vec<&RawValue>>(drawn.get()).ok()?)?,
        None => first(&[])?,
    };
    let total = serde_json::value::to_raw_value(&total).ok()?;
    parts.insert("members".to_string(), &members);
    parts.insert("drawn".to_string(), &drawn);
    parts.insert("members_total".to_string(), &total);
    serde_json::to_string(&parts).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_very_many_members_the_page_has_the_first_and_their_number() {
        let summary = |count: usize| {
            let members: Vec<String> = (0..count)
                .map(|k| format!("{{\"force\": {k}.5}}"))
                .collect();
            format!(
                "{{\"title\": \"a\", \"members\": [{}], \"z\": {{\"y\": 1, \"b\": 2.0}}}}",
                members.join(",")
            )
        };
        let few = summary(MEMBER_LIMIT);
        assert_eq!(for_page(&few), few);
        let many = for_page(&summary(30_000)).into_owned();
        assert!(many.len() < 20_000, "{}", many.len());
        let read: serde_json::Value = serde_json::from_str(&many).unwrap();
        assert_eq!(read["members_total"], 30_000);
        assert_eq!(read["members"].as_array().unwrap().len(), MEMBER_LIMIT);
        assert_eq!(read["members"][MEMBER_LIMIT - 1]["force"], 499.5);
        // the order of what is inside stays: names of results stand in that of the report
        assert!(many.contains("{\"y\": 1, \"b\": 2.0}"), "{many}");
        assert_eq!(for_page("no JSON"), "no JSON");
    }
}
