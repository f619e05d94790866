//! Formulas that the texts use, in both forms, and mistakes that are refused.

use super::{formulas, html, unicode};
use quick_xml::{Reader, events::Event};

fn line(text: &str) -> String {
    unicode(text).expect(text)
}

fn page(text: &str) -> String {
    html(text).expect(text).into_string()
}

#[test]
fn formulas_are_lines_of_unicode() {
    let texts = [
        (r"x^T M\,x \ge 0", "xᵀM x ≥ 0"),
        (r"\mu_i\lambda_i\sigma_i", "μᵢλᵢσᵢ"),
        (r"\dot\varphi = J\,v", "φ̇ = J v"),
        (r"\ddot x + \hat A \tilde W", "ẍ + ÂW̃"),
        (r"v^+ = -e\,v^-", "v⁺ = −e v⁻"),
        (r"h^2\theta^2 k", "h²θ²k"),
        (r"\tfrac12(1 + e)", "½(1 + e)"),
        (r"\frac{a + b}{2c}", "(a + b)/(2c)"),
        (r"\|u_t\| \le \mu u_n", "‖u_t‖ ≤ μu_n"),
        (r"\sqrt{1 + \mu^2} + \sqrt2 + \sqrt[3]k", "√(1 + μ²) + √2 + ∛k"),
        (r"x_{long} + v_\text{free} + v_{1/2}^T", "x_long + v_free + v_{1/2}ᵀ"),
        (r"\sum_i\mu_i \in \mathbb{R}^n, -3", "Σᵢμᵢ ∈ ℝⁿ, −3"),
        (r"-\ln x/\det W", "−ln x/det W"),
        (r"\max(0, -x) + 2\sin\theta", "max(0, −x) + 2 sin θ"),
        (r"e^{-\alpha t} + x^{k + 1}", "e^{−αt} + xᵏ⁺¹"),
        (r"x < y > z \& w", "x < y > z&w"),
        (r"a \notin \{0\}, a \ne b", "a ∉ {0}, a ≠ b"),
        (r"[[1, -1], [0, 1/2]]", "[[1, −1], [0, 1/2]]"),
        (r"\begin{bmatrix}1 & -1\\0 & 1\end{bmatrix}", "[[1, −1], [0, 1]]"),
    ];
    for (tex, wanted) in texts {
        assert_eq!(line(&format!("${tex}$")), wanted, "{tex}");
        well_formed(&page(&format!("${tex}$"))).expect(tex);
    }
}

/// Whether the tags of a page are balanced.
fn well_formed(page: &str) -> Result<(), quick_xml::Error> {
    let mut reader = Reader::from_str(page);
    while !matches!(reader.read_event()?, Event::Eof) {}
    Ok(())
}

#[test]
fn pages_have_the_formula_as_mathml_the_code_as_code_and_the_rest_escaped() {
    let page = page("a < b, `$x <i>`: $x_1 < \\mu$");
    assert!(page.starts_with("a &lt; b, <code>$x &lt;i&gt;</code>: <math"), "{page}");
    assert!(page.contains("<msub><mi>x</mi><mn>1</mn></msub>") && page.contains("&lt;") && page.contains("<mi>μ</mi>"), "{page}");
    assert!(page.ends_with("</math>"), "{page}");
    well_formed(&page).expect(&page);
    assert!(well_formed("<a><b></a>").is_err());
}

#[test]
fn the_space_before_a_function_is_no_part_of_its_script() {
    let page = page(r"$3\cos^2 x$");
    assert!(page.contains("<msup><mi>cos</mi><mn>2</mn></msup>"), "{page}");
    assert!(page.contains("/><msup>"), "the space stands before the script: {page}");
}

#[test]
fn a_comma_stays_on_the_line_of_its_formula() {
    assert!(page("$x$, and").contains("</math>\u{2060}, and"));
    assert!(page("$x$ and").contains("</math> and"));
}

#[test]
fn code_keeps_its_dollars_and_backslashes_and_white_space_is_one_space() {
    assert_eq!(line("is `$a \\b`,\n     and\n $x$"), "is `$a \\b`, and x");
    assert_eq!(formulas("`$a$` $x$ and $y^2$").expect("two formulas"), ["x", "y^2"]);
}

#[test]
fn mistakes_are_refused_by_the_name_of_the_formula() {
    let mistakes = [
        (r"$\notacommand x$", r"\notacommand"),
        (r"$\sqrt{x$", r"\sqrt{x"),
        (r"$x}$", "x}"),
        ("is $x and no more", "x and no more"),
        ("is `x and no more", "x and no more"),
        (r"the letter \mu", r"\mu"),
        ("$μ$", "μ"),
        ("$$", "$$"),
        (r"$x_1_2$", "x_1_2"),
    ];
    for (text, name) in mistakes {
        let (terminal, page) = (unicode(text), html(text));
        assert!(terminal.is_err() && page.is_err(), "{text}");
        assert!(terminal.expect_err(text).to_string().contains(name) && page.expect_err(text).to_string().contains(name), "{text}");
    }
}

#[test]
fn what_unicode_cannot_write_is_refused_and_not_approximated() {
    for tex in [r"\hat{xy}", r"\sqrt[5]{x}", r"\not{\Rightarrow}", r"\begin{cases}a & b\end{cases}"] {
        assert!(unicode(&format!("${tex}$")).is_err(), "{tex}");
    }
}
