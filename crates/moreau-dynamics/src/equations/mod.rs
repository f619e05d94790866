//! The main equations of this crate, as a page to read: documentation only.
//!
//! The text is `source.md` beside this file, with formulas in TeX; what is shown is made of it, with formulas in MathML, which needs
//! neither JavaScript nor fonts from elsewhere. In the source of each module its equations stand in Unicode.
#![doc = include_str!("page.md")]
