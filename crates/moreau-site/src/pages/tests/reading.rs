//! What a reader looks for: by severity, by Chinese words, in the language of the page.

use super::*;
use crate::punctuation::half_width;

fn page(files: &[File], path: &str) -> String {
    files.iter().find(|file| file.path == path).expect("written").text.clone()
}

/// The files of a report whose claims are changed.
fn changed(change: impl Fn(&mut ClaimEntry)) -> Vec<File> {
    let parts = Parts::new("text");
    let mut report = report("text", &parts);
    report.claims.iter_mut().for_each(change);
    without_runs(&report, &|| ()).expect("drawn")
}

#[test]
fn a_chinese_page_joins_its_texts_with_full_width_marks() {
    let files = written("…");
    // the marks of verdicts, ? and !, are no punctuation
    let said = |page: &str| half_width(&heard(page, "en").replace(['\n', '?', '!'], ""));
    for page in pages(&files).filter(|page| page.path.starts_with("zh/")) {
        assert_eq!(said(&page.text), Vec::<String>::new(), "{}", page.path);
    }
    let planted = page(&files, "zh/summary.html").replace("证据：", "证据: ");
    assert_eq!(said(&planted).len(), 1);
}

#[test]
fn the_errata_lead_from_severities_to_lists_and_from_lists_to_entries() {
    let files = changed(|claim| {
        claim.severity = claim.severity.map(|_| if claim.group == "R" { Severity::BrokenTheorem } else { Severity::Misprint });
    });
    for path in ["errata.html", "zh/errata.html"] {
        let text = page(&files, path);
        let at = |words: &str| text.find(words).unwrap_or_else(|| panic!("{path} has no {words}"));
        let (counts, gravest, least, first) = (
            at("href=\"#severity-broken-theorem\""),
            at("id=\"severity-broken-theorem\""),
            at("id=\"severity-misprint\""),
            at("id=\"S4.2\""),
        );
        assert!(counts < gravest && gravest < at("href=\"#R2\"") && at("href=\"#R2\"") < least, "{path}: most severe first");
        assert!(least < at("href=\"#S4.2\"") && at("href=\"#S4.2\"") < first, "{path}: the lists stand before the entries");
    }
}

#[test]
fn the_chinese_list_is_searched_in_chinese_and_the_english_one_is_not() {
    let files = changed(|claim| {
        let part = |text: &str| format!("{text}$\\mu$");
        claim.erratum = Some(Erratum { says: part("说法"), wrong: part("错因"), reads: part("正解") });
        claim.places[0].heading = "某节标题".into();
        claim.places[0].words = "引文几字".into();
    });
    let (english, chinese) = (page(&files, "claims.html"), page(&files, "zh/claims.html"));
    for words in ["说法μ", "错因μ", "正解μ", "某节标题", "引文几字"] {
        assert!(chinese.contains(words) && !english.contains(words), "{words}");
    }
    assert!(chinese.contains("<p data-text>说法μ</p>"), "the Chinese statement is seen");
}

#[test]
fn what_holds_as_stated_does_not_read_as_a_correction() {
    let correct = |text: &'static str| {
        changed(move |claim| {
            claim.correct = text.into();
            claim.plain[1] = text.into();
        })
    };
    let holds = |path: &str, files: &[File]| page(files, path);
    let files = correct("As stated: beyond.");
    for (path, words) in [("section-S4.html", "<h3>Holds as stated</h3>"), ("zh/section-S4.html", "<h3>如文所述，成立</h3>")] {
        assert!(holds(path, &files).contains(words) && !page(&files, path).contains("<p>As stated"), "{path}");
    }
    let list = page(&files, "claims.html");
    assert!(list.contains("data-text>Holds as stated: beyond.</p>") && !list.contains("should read: </span>As stated"));
    assert!(page(&correct("Something else."), "section-S4.html").contains("<h3>More precisely</h3>"));
}

#[test]
fn a_claim_leads_to_those_that_it_names_and_that_name_it() {
    let files = changed(|claim| {
        if claim.id == "S4.1" {
            claim.argument = "falls with S4.2, as S4.20 does".into();
        }
    });
    let text = page(&files, "section-S4.html");
    let of =
        |id: &str| text.split(&format!("id=\"{id}\"")).nth(1).expect("an article").split("</article>").next().expect("its end").to_string();
    assert!(of("S4.1").contains("See also: ") && of("S4.1").contains("section-S4.html#S4.2"));
    assert!(of("S4.2").contains("See also: ") && of("S4.2").contains("section-S4.html#S4.1"));
    assert!(!of("S4.3").contains("See also: "));
}

#[test]
fn a_chinese_page_puts_the_chinese_first_and_says_truly_what_stays_english() {
    let files = changed(|claim| {
        claim.erratum = Some(Erratum { says: "中文说法".into(), wrong: "中文错因".into(), reads: "中文正解".into() })
    });
    let section = page(&files, "zh/section-S4.html");
    let quoted = section.split("<blockquote>").nth(1).expect("a statement");
    assert!(quoted.find("中文说法") < quoted.find("lang=\"en\""), "{quoted:.200}");
    let summary = page(&files, "zh/summary.html");
    assert!(summary.contains("中文说法") && summary.contains("在本章别处重复出现的：0 条"));
    assert!(page(&files, "zh/errata.html").contains("陈述、问题所在与更正为中文"));
}

#[test]
fn the_table_of_sections_scrolls_in_no_box() {
    for path in ["index.html", "summary.html", "zh/index.html", "zh/summary.html"] {
        let text = page(&written("text"), path);
        let (before, _) = text.split_once("<table class=\"sections\"").expect("the table");
        assert_eq!(before.matches("class=\"scroll\"").count(), 0, "{path}");
    }
}
