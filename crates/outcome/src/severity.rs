//! How severe a warning is: few of them decide whether a result may be used at all.

use std::cmp::Ordering;

/// The result is that of another machine, or what it shows is destruction.
const GRAVE: &[&str] = &[
    "AB1001", "AB1002", "AB1004", "AB1005", "AB1006", "AB1014", "AB1015", "AB1017", "AB1018",
    "AB1029", "AB1031", "AB1032", "AB1035", "AB1042", "AB1044", "AB1060", "AB1063", "AB1070",
    "AB1090", "AB1092", "AB1094", "AB1095", "AB1096", "AB1097", "AB1127", "AB1128", "AB2021",
    "AB2030", "AB2031", "AB2032", "AB2033", "AB2035", "AB2040", "AB2042", "AB2043", "AB2079",
    "AB2300", "AB2301", "AB2302", "AB2303", "AB2311", "AB2312", "AB2314", "AB2323", "AB2324",
    "AB2336",
];
/// What is left out, or to be kept in mind.
const REMARKS: &[&str] = &[
    "AB1007", "AB1008", "AB1010", "AB1011", "AB1012", "AB1020", "AB1022", "AB1023", "AB1052",
    "AB1062", "AB1071", "AB1093", "AB1126", "AB2025",
];
/// Inputs that were assumed: every run has some.
const ASSUMED: &str = "AB1013";

/// 0 the most severe, 3 the least; 1 is what no list names.
pub fn severity(code: &str) -> u8 {
    match code {
        ASSUMED => 3,
        code if GRAVE.contains(&code) => 0,
        code if REMARKS.contains(&code) => 2,
        _ => 1,
    }
}

/// The more severe first, then by the code.
pub fn more_severe(a: &str, b: &str) -> Ordering {
    severity(a).cmp(&severity(b)).then_with(|| a.cmp(b))
}
