//! Coverage against areas by hand, and what cannot be right refused or harmless.
