//! Lists of advisories.

use super::*;

const PAGE: &str = "```toml\n[advisory]\nid = \"RUSTSEC-2026-0001\"\npackage = \"one\"\ndate = \"2026-02-03\"\n\n\
    [versions]\npatched = [\">= 0.41.0\"]\nunaffected = [\"< 0.20\"]\n```\n\n# Slow\n";

#[test]
fn an_advisory_is_found_until_it_is_patched_or_accepted() {
    let folder = std::env::temp_dir().join(format!("auxbear-advisories-{}", std::process::id()));
    let pages = [
        ("one", PAGE.to_owned()),
        ("two", PAGE.replace("one", "two").replace("-0001", "-0002")),
        (
            "gone",
            PAGE.replace("0001\"", "0003\"\nwithdrawn = \"2026-03-01\""),
        ),
    ];
    for (name, page) in pages {
        let own = folder.join("crates").join(name);
        std::fs::create_dir_all(&own).unwrap();
        std::fs::write(own.join("RUSTSEC.md"), page).unwrap();
    }
    let with = |version: &str| Packages::from([("one".to_owned(), vec![version.to_owned()])]);
    let list = gather(&folder, &with("0.38.4"), List::default()).unwrap();
    assert_eq!((list.looked_at, list.newest.as_str()), (3, "2026-02-03"));
    assert_eq!(list.advisories.len(), 1);
    let found = findings(&list, &with("0.38.4"));
    assert!(
        found.len() == 1 && found[0].contains("one 0.38.4: RUSTSEC-2026-0001"),
        "{found:?}"
    );
    for version in ["0.41.0", "1.0.0", "0.19.9"] {
        assert!(findings(&list, &with(version)).is_empty(), "{version}");
    }
    // a reason stays when the list is written anew, and so does an entry that the copy lacks
    let written = text(&list).replace(
        "[\"< 0.20\"]\n",
        "[\"< 0.20\"]\naccepted = \"not reached\"\n",
    );
    let extra = "\n[RUSTSEC-2026-0009]\npackage = \"one\"\npatched = []\norigin = \"by hand\"\n";
    std::fs::write(folder.join(LIST), written + extra).unwrap();
    let repository = Repository {
        root: folder.clone(),
        files: Vec::new(),
    };
    let list = gather(&folder, &with("0.38.4"), read(&repository).unwrap()).unwrap();
    let found = findings(&list, &with("0.38.4"));
    assert!(found.len() == 1 && found[0].contains("0009"), "{found:?}");
    assert!(text(&list).contains("accepted = \"not reached\"") && text(&list).contains("by hand"));
    assert!(gather(&folder.join("crates"), &with("1.0.0"), List::default()).is_err());
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!(check(&repository).findings.len(), 1);
}

#[test]
fn versions_lie_in_ranges_as_cargo_reads_them() {
    for (version, range, lies) in [
        ("1.2.3", ">= 1.2.0, < 2", true),
        ("2.0.0", ">= 1.2.0, < 2", false),
        ("0.3.4", "^0.3.1", true),
        ("0.4.0", "^0.3.1", false),
        ("1.9.0", "^1.2", true),
        ("1.0.0-rc.1", ">= 1.0.0", false),
        ("1.0.0+a", "=1.0.0", true),
        ("1.2.9", "~1.2.3", true),
        ("1.10.0", "> 1.9.0", true),
        ("1.9.0", "<= 1.9", true),
    ] {
        assert_eq!(lies_in(version, range), lies, "{version} {range}");
    }
}
