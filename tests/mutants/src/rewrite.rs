//! Source files with switches.

use std::collections::HashMap;
use std::ops::Range;

use proc_macro2::{LineColumn, Span};
use syn::spanned::Spanned as _;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr};

use crate::list::{Genre, Mutant};
use crate::tables::tables;

/// A file in which mutants are switched.
pub(crate) struct Rewritten {
    pub(crate) text: String,
    /// The places of switches in the text, and their mutants.
    pub(crate) regions: Vec<(Range<usize>, Vec<usize>)>,
}

/// A piece of source that is written in another way. Ranges are bytes of the source.
struct Node {
    range: Range<usize>,
    /// The mutants, by their numbers, with their replacements.
    ways: Vec<(usize, String)>,
    kind: Kind,
}

enum Kind {
    /// The same between two other texts.
    Within(&'static str, &'static str),
    /// Another value at the beginning of a function.
    Value,
    /// An operator that evaluates both sides. Comparisons borrow them.
    Binary { left: Range<usize>, right: Range<usize>, operator: String, compares: bool },
    /// `&&` or `||`.
    Lazy { left: Range<usize>, right: Range<usize>, is_and: bool },
    /// An operator that assigns.
    Assign { left: Range<usize>, right: Range<usize>, operator: String },
    /// `-` or `!`, which is left out.
    Unary { operand: Range<usize>, operator: String },
    /// A pattern without a guard, whose arm is left out.
    Arm,
    /// A guard.
    Guard { is_left_out: Option<usize> },
}

/// Writes a file with these of its mutants.
pub(crate) fn rewrite(source: &str, mutants: &[(usize, &Mutant)]) -> Result<Rewritten, String> {
    let file = syn::parse_file(source).map_err(|error| error.to_string())?;
    let lines = Lines::of(source);
    let mut places: HashMap<(usize, bool), Vec<(usize, &Mutant)>> = HashMap::new();
    let mut nodes = Vec::new();
    for &(number, mutant) in mutants {
        let at = lines.offset(mutant.place.0, mutant.place.1 - 1);
        if mutant.genre == Genre::Value {
            // Two values of such a function have two types.
            if mutant.name.contains(" -> impl ") {
                continue;
            }
            let ways = vec![(number, mutant.replacement.clone())];
            nodes.push(Node { range: at..at, ways, kind: Kind::Value });
        } else {
            places.entry((at, mutant.genre == Genre::Arm)).or_default().push((number, mutant));
        }
    }
    // Before the others: where both have the same range, this is around.
    for table in tables(&file) {
        let pieces = [
            (table.keyword, ("static /* ", " */")),
            (table.kind, ("crate::mutant_std::sync::LazyLock<", ">")),
            (table.value, ("crate::mutant_std::sync::LazyLock::new(|| ", ")")),
        ];
        nodes.extend(pieces.map(|(span, (before, after))| Node {
            range: lines.range(span),
            ways: Vec::new(),
            kind: Kind::Within(before, after),
        }));
    }
    let mut finder = Finder { source, lines: &lines, places, nodes };
    finder.visit_file(&file);
    let mut nodes = finder.nodes;
    // The outer before the inner, and what is put in before both.
    nodes.sort_by_key(|node| (node.range.start, !node.range.is_empty(), usize::MAX - node.range.end));
    let mut writer = Writer { source, nodes: &nodes, text: String::new(), regions: Vec::new() };
    writer.copy(0..source.len(), 0);
    Ok(Rewritten { text: writer.text, regions: writer.regions })
}

/// The offsets of lines.
struct Lines<'a> {
    source: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn of(source: &'a str) -> Self {
        let ends = source.match_indices('\n').map(|(at, _)| at + 1);
        Self { source, starts: std::iter::once(0).chain(ends).collect() }
    }

    /// The byte at a letter of a line, from 1, after so many letters.
    fn offset(&self, line: usize, letters: usize) -> usize {
        let start = self.starts[line - 1];
        let rest = &self.source[start..];
        start + rest.char_indices().nth(letters).map_or(rest.len(), |(at, _)| at)
    }

    fn range(&self, span: Span) -> Range<usize> {
        let at = |place: LineColumn| self.offset(place.line, place.column);
        at(span.start())..at(span.end())
    }
}

/// Looks for the expressions of mutants.
struct Finder<'a> {
    source: &'a str,
    lines: &'a Lines<'a>,
    places: HashMap<(usize, bool), Vec<(usize, &'a Mutant)>>,
    nodes: Vec<Node>,
}

impl Finder<'_> {
    fn take(&mut self, at: usize, is_arm: bool) -> Vec<(usize, String)> {
        let found = self.places.remove(&(at, is_arm)).unwrap_or_default();
        found.into_iter().map(|(number, mutant)| (number, mutant.replacement.clone())).collect()
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_expr_binary(&mut self, expression: &'ast syn::ExprBinary) {
        let operator = self.lines.range(expression.op.span());
        let ways = self.take(operator.start, false);
        if !ways.is_empty() {
            let [left, right] =
                [&expression.left, &expression.right].map(|side| self.lines.range(side.span()));
            let text = self.source[operator].to_owned();
            let has_let = |side: &Expr| matches!(side, Expr::Let(_));
            let kind = match expression.op {
                BinOp::And(_) | BinOp::Or(_) if has_let(&expression.left) || has_let(&expression.right) => {
                    None
                }
                BinOp::And(_) => Some(Kind::Lazy { left, right, is_and: true }),
                BinOp::Or(_) => Some(Kind::Lazy { left, right, is_and: false }),
                BinOp::Eq(_) | BinOp::Ne(_) | BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) => {
                    Some(Kind::Binary { left, right, operator: text, compares: true })
                }
                _ if text.ends_with('=') => Some(Kind::Assign { left, right, operator: text }),
                _ => Some(Kind::Binary { left, right, operator: text, compares: false }),
            };
            let range = self.lines.range(expression.span());
            self.nodes.extend(kind.map(|kind| Node { range, ways, kind }));
        }
        visit::visit_expr_binary(self, expression);
    }

    fn visit_expr_unary(&mut self, expression: &'ast syn::ExprUnary) {
        let operator = self.lines.range(expression.op.span());
        let ways = self.take(operator.start, false);
        if !ways.is_empty() {
            let operand = self.lines.range(expression.expr.span());
            let kind = Kind::Unary { operand, operator: self.source[operator].to_owned() };
            self.nodes.push(Node { range: self.lines.range(expression.span()), ways, kind });
        }
        visit::visit_expr_unary(self, expression);
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        let pattern = self.lines.range(arm.pat.span());
        let attributes = arm.attrs.first().map(|first| self.lines.range(first.span()).start);
        let mut left_out = self.take(pattern.start, true);
        left_out.extend(attributes.into_iter().flat_map(|at| self.take(at, true)));
        match &arm.guard {
            Some((_, guard)) => {
                let range = self.lines.range(guard.span());
                let mut ways = self.take(range.start, false);
                let is_left_out = left_out.first().map(|(number, _)| *number);
                if !ways.is_empty() || is_left_out.is_some() {
                    ways.extend(left_out);
                    self.nodes.push(Node { range, ways, kind: Kind::Guard { is_left_out } });
                }
            }
            None if !left_out.is_empty() => {
                let range = pattern.end..pattern.end;
                self.nodes.push(Node { range, ways: left_out, kind: Kind::Arm });
            }
            None => {}
        }
        visit::visit_arm(self, arm);
    }
}

/// Copies a source, but for its nodes.
struct Writer<'a> {
    source: &'a str,
    nodes: &'a [Node],
    text: String,
    regions: Vec<(Range<usize>, Vec<usize>)>,
}

impl Writer<'_> {
    /// Writes a range, and of the nodes from `first` on those in it.
    fn copy(&mut self, range: Range<usize>, first: usize) {
        let mut at = range.start;
        for (index, node) in self.nodes.iter().enumerate().skip(first) {
            if node.range.start < at || node.range.end > range.end {
                if node.range.start > range.end {
                    break;
                }
                continue;
            }
            self.text.push_str(&self.source[at..node.range.start]);
            at = node.range.end;
            self.write(node, index + 1);
        }
        self.text.push_str(&self.source[at..range.end]);
    }

    fn write(&mut self, node: &Node, next: usize) {
        let start = self.text.len();
        let ways = |write: &dyn Fn(&str) -> String| {
            let way = |(number, other): &(usize, String)| {
                format!("if crate::mutant({number}) {{ {} }} else ", write(other))
            };
            node.ways.iter().map(way).collect::<String>()
        };
        let switch = |number: usize| format!("crate::mutant({number})");
        match &node.kind {
            Kind::Within(before, after) => {
                self.text.push_str(before);
                self.copy(node.range.clone(), next);
                self.text.push_str(after);
                return;
            }
            Kind::Value => {
                for (number, value) in &node.ways {
                    self.text.push_str(&format!("if crate::mutant({number}) {{ return {value}; }} "));
                }
            }
            Kind::Binary { left, right, operator, compares } => {
                let (by, star) = if *compares { ("&", "*") } else { ("", "") };
                self.text.push_str(&format!("(match ({by}("));
                self.copy(left.clone(), next);
                self.text.push_str(&format!("), {by}("));
                self.copy(right.clone(), next);
                let write = |operator: &str| format!("{star}mutant_l {operator} {star}mutant_r");
                let ways = ways(&write);
                self.text
                    .push_str(&format!(")) {{ (mutant_l, mutant_r) => {ways}{{ {} }} }})", write(operator)));
            }
            Kind::Lazy { left, right, is_and } => {
                // The left side decides if it is false for `&&`, and if it is true for `||`.
                let changed =
                    node.ways.iter().map(|(number, _)| switch(*number)).collect::<Vec<_>>().join(" || ");
                self.text.push_str("({ let mutant_l: bool = ");
                self.copy(left.clone(), next);
                self.text
                    .push_str(&format!("; if mutant_l != (({changed}) != {is_and}) {{ mutant_l }} else {{ "));
                self.copy(right.clone(), next);
                self.text.push_str(" } })");
            }
            Kind::Assign { left, right, operator } => {
                self.text.push_str("match ");
                self.copy(right.clone(), next);
                // The place is written again for each of them.
                self.text.push_str(" { mutant_r => ");
                for (number, operator) in &node.ways {
                    self.text.push_str(&format!("if {} {{ ", switch(*number)));
                    self.copy(left.clone(), next);
                    self.text.push_str(&format!(" {operator} mutant_r; }} else "));
                }
                self.text.push_str("{ ");
                self.copy(left.clone(), next);
                self.text.push_str(&format!(" {operator} mutant_r; }} }}"));
            }
            Kind::Unary { operand, operator } => {
                self.text.push_str("(match ");
                self.copy(operand.clone(), next);
                let ways = ways(&|_| "mutant_v".to_owned());
                self.text.push_str(&format!(" {{ mutant_v => {ways}{{ {operator}mutant_v }} }})"));
            }
            Kind::Arm => {
                let all = node.ways.iter().map(|(number, _)| format!("!{}", switch(*number)));
                self.text.push_str(&format!(" if {}", all.collect::<Vec<_>>().join(" && ")));
            }
            Kind::Guard { is_left_out } => {
                let kept = is_left_out.map(|number| format!("!{} && ", switch(number))).unwrap_or_default();
                self.text.push_str(&format!("{kept}("));
                for (number, value) in node.ways.iter().filter(|(number, _)| Some(*number) != *is_left_out) {
                    match value.as_str() {
                        "true" => self.text.push_str(&format!("{} || ", switch(*number))),
                        _ => self.text.push_str(&format!("!{} && ", switch(*number))),
                    }
                }
                self.text.push('(');
                self.copy(node.range.clone(), next);
                self.text.push_str("))");
            }
        }
        let numbers = node.ways.iter().map(|(number, _)| *number).collect();
        self.regions.push((start..self.text.len(), numbers));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mutant(genre: Genre, replacement: &str, place: (usize, usize)) -> Mutant {
        let replacement = replacement.to_owned();
        Mutant { name: String::new(), file: "a.rs".into(), genre, replacement, place }
    }

    fn written(source: &str, mutants: &[Mutant]) -> String {
        let numbered: Vec<_> = mutants.iter().enumerate().collect();
        let rewritten = rewrite(source, &numbered).unwrap();
        syn::parse_file(&rewritten.text).unwrap();
        for (range, numbers) in &rewritten.regions {
            let text = &rewritten.text[range.clone()];
            assert!(numbers.iter().all(|number| text.contains(&format!("mutant({number})"))), "{text}");
        }
        rewritten.text
    }

    #[test]
    fn operators_are_switched_where_they_stand() {
        let source = "fn f(ä: f32, b: f32) -> f32 { ä + b * 2.0 }\n";
        let column = |what: char| source.chars().position(|c| c == what).unwrap() + 1;
        let mutants = [
            mutant(Genre::Value, "1.0", (1, column('{') + 2)),
            mutant(Genre::Binary, "-", (1, column('+'))),
            mutant(Genre::Binary, "/", (1, column('*'))),
        ];
        assert_eq!(
            written(source, &mutants),
            "fn f(ä: f32, b: f32) -> f32 { if crate::mutant(0) { return 1.0; } (match ((ä), ((match ((b), (2.0)) { \
             (mutant_l, mutant_r) => if crate::mutant(2) { mutant_l / mutant_r } else { mutant_l * mutant_r } }))) { \
             (mutant_l, mutant_r) => if crate::mutant(1) { mutant_l - mutant_r } else { mutant_l + mutant_r } }) }\n"
        );
    }

    #[test]
    fn arms_and_guards_are_switched() {
        let source = "fn f(x: u8) -> u8 {\n match x {\n 0 => 1,\n 3 if x > 2 => 4,\n _ => 5,\n }\n}\n";
        let mutants = [
            mutant(Genre::Arm, "", (3, 2)),
            mutant(Genre::Arm, "", (4, 2)),
            mutant(Genre::Guard, "true", (4, 7)),
            mutant(Genre::Guard, "false", (4, 7)),
        ];
        let text = written(source, &mutants);
        assert!(text.contains("0 if !crate::mutant(0) => 1"), "{text}");
        let guard = "3 if !crate::mutant(1) && (crate::mutant(2) || !crate::mutant(3) && (x > 2)) => 4";
        assert!(text.contains(guard), "{text}");
    }

    #[test]
    fn tables_are_made_while_running() {
        let source = "const T: [u8; 2] = { [1 + 1; 2] };\nfn f() -> u8 { T[0] }\n";
        let column = source.find('+').unwrap() + 1;
        assert_eq!(
            written(source, &[mutant(Genre::Binary, "-", (1, column))]),
            "static /* const */ T: crate::mutant_std::sync::LazyLock<[u8; 2]> = \
             crate::mutant_std::sync::LazyLock::new(|| { [(match ((1), (1)) { (mutant_l, mutant_r) => \
             if crate::mutant(0) { mutant_l - mutant_r } else { mutant_l + mutant_r } }); 2] });\n\
             fn f() -> u8 { T[0] }\n"
        );
    }

    /// The switch of `&&` and `||`, by a table of truth.
    #[test]
    fn lazy_operators_are_the_other_one() {
        let text = written("fn f() -> bool { a && b }\n", &[mutant(Genre::Binary, "||", (1, 20))]);
        assert!(text.contains(
            "mutant_l: bool = a; if mutant_l != ((crate::mutant(0)) != true) { mutant_l } else { b }"
        ));
        for (is_and, changed, left, right) in
            (0..16).map(|k| (k & 1 == 1, k & 2 == 2, k & 4 == 4, k & 8 == 8))
        {
            let found = if left != (changed != is_and) { left } else { right };
            assert_eq!(found, if is_and != changed { left && right } else { left || right });
        }
    }
}
