//! Files `contact-problem/1` and `solution/1`.
