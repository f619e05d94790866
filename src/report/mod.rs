//! Reports: text, JSON and pictures of what was found.
