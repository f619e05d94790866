//! What is said of a claim on each axis – verdict, severity, kind, evidence – in words, with a key for links and filters.

use crate::words::Words;

/// One value of an axis.
pub trait Axis: Copy + PartialEq + Sized + 'static {
    /// Every value, in the order in which they are shown.
    const ALL: &'static [Self];

    /// Letters and hyphens: the value in links, filters and `report.json`.
    fn key(self) -> &'static str;

    /// The words for a reader.
    fn words(self) -> Words;
}

/// An axis: its values, each with its key and its words.
macro_rules! axis {
    ($(#[$doc:meta])* $name:ident { $($(#[$of:meta])* $value:ident = $key:literal, $en:literal, $zh:literal;)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$of])* $value,)+ }

        impl Axis for $name {
            const ALL: &'static [Self] = &[$($name::$value),+];

            fn key(self) -> &'static str {
                match self { $($name::$value => $key),+ }
            }

            fn words(self) -> Words {
                match self { $($name::$value => Words { en: $en, zh: $zh }),+ }
            }
        }
    };
}

axis! {
    /// What became of a claim.
    Verdict {
        /// Holds as stated.
        True = "true", "true", "正确";
        /// Holds under conditions the text omits.
        Conditional = "conditional", "conditional", "有条件成立";
        /// Does not hold as printed.
        False = "false", "false as stated", "如所述不成立";
        /// The text states two things that exclude each other.
        Inconsistent = "inconsistent", "inconsistent", "自相矛盾";
        /// Has readings that differ in truth, or cannot be decided.
        Ambiguous = "ambiguous", "ambiguous", "含义不明";
    }
}

axis! {
    /// How much is wrong.
    Severity {
        /// A slip that a reader corrects at sight.
        Misprint = "misprint", "misprint", "笔误";
        /// What is said holds, for another reason than the one given.
        WrongReason = "wrong-reason", "wrong reason", "理由有误";
        /// It holds under a condition that is not printed.
        MissingHypothesis = "missing-hypothesis", "missing hypothesis", "缺少条件";
        /// It does not hold.
        WrongStatement = "wrong-statement", "wrong statement", "论断有误";
        /// It is offered as a theorem, and does not hold.
        BrokenTheorem = "broken-theorem", "broken theorem", "定理不成立";
    }
}

axis! {
    /// What kind of sentence it is.
    Kind {
        /// It says that something is so.
        Assertion = "assertion", "assertion", "断言";
        /// An exercise or a question, with the answer that it presumes.
        Exercise = "exercise", "exercise or question", "练习或问题";
        /// It fixes the meaning of a word or a symbol.
        Definition = "definition", "definition", "定义";
        /// It says who wrote, proved or named something.
        Citation = "citation", "citation", "引用";
        /// It names a file, a function, an option or a version.
        Path = "path", "path or version", "路径或版本";
        /// It says what to do.
        Advice = "advice", "advice", "建议";
        /// It values.
        Opinion = "opinion", "opinion", "评价";
    }
}

axis! {
    /// How strong the evidence is.
    Evidence {
        /// Rational arithmetic.
        Exact = "exact", "exact", "精确";
        /// A residual below a derived bound.
        Certified = "certified", "certified", "带误差界认证";
        /// An experiment.
        Measured = "measured", "measured", "实测";
        /// A fact about software or literature.
        Cited = "cited", "cited", "查证文献或软件";
        /// An opinion.
        NotDecidable = "not-decidable", "not decidable", "不可判定";
    }
}

axis! {
    /// What a finding has to do with the sentence.
    Role {
        /// It is as the sentence says.
        Supports = "supports", "supports", "支持";
        /// It is not as the sentence says.
        Refutes = "refutes", "refutes", "反驳";
        /// Told beside the sentence; it decides nothing.
        Context = "context", "beside", "旁证";
        /// It is not what was expected: the recorded verdict is in doubt.
        Fails = "fails", "FAILS", "不符合预期";
    }
}

impl Verdict {
    /// A shape that tells the verdict without its colour.
    pub fn mark(self) -> &'static str {
        match self {
            Verdict::True => "✓",
            Verdict::Conditional => "◐",
            Verdict::False => "✗",
            Verdict::Inconsistent => "≠",
            Verdict::Ambiguous => "?",
        }
    }

    /// Whether an errata sheet has something to say of it.
    pub fn needs_correction(self) -> bool {
        matches!(self, Verdict::Conditional | Verdict::False | Verdict::Inconsistent)
    }
}
