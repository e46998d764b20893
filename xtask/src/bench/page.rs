//! What is measured, printed and kept as one page of Markdown.

/// The page, printed line by line as it grows.
#[derive(Default)]
pub struct Page {
    text: String,
}

impl Page {
    /// A line of text.
    pub fn line(&mut self, line: &str) {
        println!("{line}");
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// A heading with its empty lines.
    pub fn heading(&mut self, heading: &str) {
        self.line("");
        self.line(&format!("## {heading}"));
        self.line("");
    }

    /// The first line of a table and the one below it.
    pub fn table<'a>(&mut self, names: impl IntoIterator<Item = &'a str>) {
        let names: Vec<&str> = names.into_iter().collect();
        self.row(&names);
        self.line(&format!("|{}", "---|".repeat(names.len())));
    }

    /// One line of a table.
    pub fn row(&mut self, cells: &[impl AsRef<str>]) {
        let cells: Vec<&str> = cells.iter().map(AsRef::as_ref).collect();
        self.line(&format!("| {} |", cells.join(" | ")));
    }

    /// All of it.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// A number in three digits.
pub fn three(value: f64) -> String {
    let digits = 2 - value.abs().max(1e-9).log10().floor() as i32;
    format!("{value:.*}", digits.clamp(0, 9) as usize)
}

/// A deviation: its sign, and no more digits than say something.
pub fn signed(value: f64) -> String {
    format!("{value:+.2}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(three(0.012345), "0.0123");
        assert_eq!(three(267.4), "267");
        assert_eq!(three(0.0), "0.000000000");
        assert_eq!(signed(-0.054), "-0.05");
    }

    #[test]
    fn a_table_has_a_rule_below_its_names() {
        let mut page = Page::default();
        page.table(["", "s"]);
        page.row(&["one", "2"]);
        assert_eq!(page.text(), "|  | s |\n|---|---|\n| one | 2 |\n");
    }
}
