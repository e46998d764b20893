//! Reports: what a run leaves behind, and the page that shows it.
//!
//! | page | subject |
//! |---|---|
//! | [`directory`] | a run directory as a whole: written in one piece or not at all, and read back |
//! | `closely` | the part of a run that its page shows closely |
//! | `summary` | `summary.json`: quantities, warnings, contacts, inputs |
//! | `history` | `history.parquet`: time histories with unit and meaning of every column |
//! | `members` | a part of the members of a study or repetition |
//! | [`page`] | one run or several as an HTML page |
//! | `place` | where the directory of a run stands |
//! | [`picture`] | one run as a picture |
//! | [`schema`] | JSON Schemas of scenarios, studies and `summary.json` |
//! | [`export`] | results and histories as CSV files or a workbook |
//! | [`study`] | a study directory: parts of members, summary, page |
//! | [`service`] | many drops of several kinds, and what they do to the bearings together |

#![forbid(unsafe_code)]

mod closely;
pub mod directory;
pub mod export;
mod figures;
mod history;
mod members;
pub mod page;
mod page_summary;
mod per_bearing;
pub mod picture;
mod place;
pub mod schema;
pub mod service;
pub mod study;
mod summary;
mod table;
#[cfg(feature = "xlsx")]
mod workbook;
