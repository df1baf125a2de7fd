//! Tables that are made while the program runs: no mutant is alive in what is computed while compiling.

use std::collections::HashSet;

use proc_macro2::Span;
use syn::visit::{self, Visit};
use syn::{Expr, Type, Visibility};

/// The crate `std` of a library's copy, which has none of its own.
pub(crate) const STD: &str = "\n#[doc(hidden)]\nextern crate std as mutant_std;\n";

/// A private `const` or `static` array that a function or a block makes.
pub(crate) struct Table {
    /// The word `const` or `static`.
    pub(crate) keyword: Span,
    pub(crate) kind: Span,
    pub(crate) value: Span,
    name: String,
}

/// The tables of a file that nothing needs while compiling.
pub(crate) fn tables(file: &syn::File) -> Vec<Table> {
    let mut tables = Tables::default();
    tables.visit_file(file);
    // A table that only tables need is made when they are.
    tables.found.retain(|table| !tables.constant.contains(&table.name));
    tables.found
}

#[derive(Default)]
struct Tables {
    found: Vec<Table>,
    /// Names in what is computed while compiling.
    constant: HashSet<String>,
    /// So many such things are around.
    depth: u32,
}

impl Tables {
    fn within(&mut self, is_constant: bool, visit: impl FnOnce(&mut Self)) {
        self.depth += u32::from(is_constant);
        visit(self);
        self.depth -= u32::from(is_constant);
    }

    /// Whether it is a table.
    fn take(&mut self, keyword: Span, item: (&Visibility, &syn::Ident, &Type, &Expr)) -> bool {
        use syn::spanned::Spanned as _;
        let (visibility, name, kind, value) = item;
        let is_made = matches!(value, Expr::Call(_) | Expr::Block(_));
        let is_table = matches!((visibility, kind), (Visibility::Inherited, Type::Array(_))) && is_made;
        if is_table {
            let name = name.to_string();
            self.found.push(Table { keyword, kind: kind.span(), value: value.span(), name });
        }
        is_table
    }
}

impl<'ast> Visit<'ast> for Tables {
    fn visit_item_const(&mut self, item: &'ast syn::ItemConst) {
        let is_table = self.take(item.const_token.span, (&item.vis, &item.ident, &item.ty, &item.expr));
        self.within(!is_table, |this| visit::visit_expr(this, &item.expr));
        self.within(true, |this| this.visit_type(&item.ty));
    }

    fn visit_item_static(&mut self, item: &'ast syn::ItemStatic) {
        let is_table = self.take(item.static_token.span, (&item.vis, &item.ident, &item.ty, &item.expr));
        self.within(!is_table, |this| visit::visit_expr(this, &item.expr));
        self.within(true, |this| this.visit_type(&item.ty));
    }

    fn visit_impl_item_const(&mut self, item: &'ast syn::ImplItemConst) {
        self.within(true, |this| visit::visit_impl_item_const(this, item));
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.within(item.sig.constness.is_some(), |this| visit::visit_item_fn(this, item));
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.within(item.sig.constness.is_some(), |this| visit::visit_impl_item_fn(this, item));
    }

    fn visit_expr_const(&mut self, block: &'ast syn::ExprConst) {
        self.within(true, |this| visit::visit_expr_const(this, block));
    }

    fn visit_type_array(&mut self, array: &'ast syn::TypeArray) {
        self.visit_type(&array.elem);
        self.within(true, |this| this.visit_expr(&array.len));
    }

    fn visit_ident(&mut self, name: &'ast syn::Ident) {
        if self.depth > 0 {
            self.constant.insert(name.to_string());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_those_that_are_made_and_read_while_running() {
        let source = "
            const LIGHT: [u8; 2] = { [1, 2] };
            const BEGIN: [u8; 2] = made();
            static LEAST: [u8; COUNT] = { let x = BEGIN[0]; [x; COUNT] };
            const COUNT: usize = { 2 };
            const WRITTEN: [u8; 2] = [1, 2];
            pub static SEEN: [u8; 2] = made();
            const fn light() -> u8 { LIGHT[0] }
            fn least() -> u8 { const INNER: [u8; 1] = made(); LEAST[0] + INNER[0] }
            struct A;
            impl A { const OF: u8 = OTHER[0]; }
            const OTHER: [u8; 1] = { [1] };
        ";
        let names = tables(&syn::parse_file(source).unwrap()).into_iter().map(|table| table.name);
        assert_eq!(names.collect::<Vec<_>>(), ["BEGIN", "LEAST", "INNER"]);
    }
}
