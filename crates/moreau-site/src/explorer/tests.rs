//! The grid, and what is stored of it.

use super::*;

#[test]
#[ignore]
fn measure() {
    let start = std::time::Instant::now();
    let files = files(&|_, _| {}).expect("valid scenes");
    println!("{:?}", start.elapsed());
    for (name, text) in &files {
        println!("{name} {}", text.len());
        if std::env::var("OUT").is_ok() {
            std::fs::create_dir_all("/tmp/explorer/explorer").expect("x");
            std::fs::write(format!("/tmp/explorer/explorer/{name}"), text).expect("x");
        }
    }
    for (language, name) in [(crate::Language::English, "en"), (crate::Language::Chinese, "zh")] {
        std::fs::create_dir_all("/tmp/explorer/").expect("x");
        std::fs::write(format!("/tmp/explorer/{name}.html"), page(language, "explorer/")).expect("x");
    }
}
