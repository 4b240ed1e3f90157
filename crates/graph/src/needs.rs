//! What is wanted of an output, and what of its inputs a node needs to make that.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::spec::OutputSpec;

/// A part of a value that some readers can do without, so that it need not be made for them. A constant of the program's, which an output declares:
/// `#[output(fur: Coat, "The coat.", parts = [SHELLS, FINS])]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Part {
    /// What it is called, in the trace.
    pub name: &'static str,
    /// What it is.
    pub doc: &'static str,
}

/// Parts of an output, by their places in its specification.
pub(crate) type PartSet = BTreeSet<usize>;

/// An output that is wanted, and which of its parts are.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'w> {
    pub(crate) output: &'w OutputSpec,
    pub(crate) parts: &'w PartSet,
}

impl<'w> Wanted<'w> {
    /// The output's name.
    pub fn output(&self) -> &'w str {
        &self.output.name
    }

    /// Whether one of its parts is wanted; `false` for a part that it does not declare.
    pub fn part(&self, part: Part) -> bool {
        self.parts().any(|wanted| wanted == part)
    }

    /// Its parts that are wanted, in the order in which it declares them.
    pub fn parts(&self) -> impl Iterator<Item = Part> + use<'w> {
        let output = self.output;
        self.parts.iter().filter_map(|&place| output.parts.get(place).copied())
    }
}

/// What of its inputs a node needs to make an output. It begins with all of everything, from which the node takes away.
///
/// It is a promise: what is taken away may be there all the same, for another output or another reader, and must not change what is made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Inputs that are not needed, or not whole.
    inputs: Vec<(&'static str, Reading)>,
    absent: Vec<Part>,
    present: Vec<Part>,
}

/// What is read of an input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Reading {
    Nothing,
    Parts(Vec<Part>),
    Whole,
}

impl Needs {
    /// All inputs, whole.
    pub fn all() -> Self {
        Self::default()
    }

    /// Without an input. It is neither made for this output nor part of its key; unless another output needs it, the struct holds `None`, or an empty list.
    /// An input that the struct cannot do without, `Arc<T>`, is read whole all the same.
    #[must_use]
    pub fn without(self, input: &'static str) -> Self {
        self.reading(input, Reading::Nothing)
    }

    /// Of an input those parts alone, whatever else it has; with none of them still what is no part.
    #[must_use]
    pub fn parts(self, input: &'static str, parts: impl IntoIterator<Item = Part>) -> Self {
        self.reading(input, Reading::Parts(parts.into_iter().collect()))
    }

    /// The output has no such part, with these parameters and links: wanted or not, the value is the same, and so is its key.
    #[must_use]
    pub fn absent(mut self, part: Part) -> Self {
        self.absent.push(part);
        self
    }

    /// The output has this part, as it comes with others that are wanted: wanted or not itself, the value is the same, and so is its key.
    #[must_use]
    pub fn present(mut self, part: Part) -> Self {
        self.present.push(part);
        self
    }

    fn reading(mut self, input: &'static str, reading: Reading) -> Self {
        self.inputs.retain(|(other, _)| *other != input);
        self.inputs.push((input, reading));
        self
    }

    /// What is read of an input.
    pub(crate) fn of(&self, input: &str) -> &Reading {
        self.inputs.iter().find(|(name, _)| *name == input).map_or(&Reading::Whole, |(_, reading)| reading)
    }

    /// The inputs of which something is taken away.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = (&'static str, &Reading)> {
        self.inputs.iter().map(|(input, reading)| (*input, reading))
    }

    /// Of an output the parts that are made where these are asked for, and those that there are besides.
    pub(crate) fn made_of(&self, output: &OutputSpec, asked: &PartSet) -> (PartSet, PartSet) {
        let among = |parts: &[Part], place: usize| parts.contains(&output.parts[place]);
        let there = (0..output.parts.len()).filter(|&place| !among(&self.absent, place));
        there.partition(|place| asked.contains(place) || among(&self.present, *place))
    }
}

impl Reading {
    /// Those of an output's parts that are read; `None` if nothing at all is.
    pub(crate) fn of(&self, output: &OutputSpec) -> Option<PartSet> {
        match self {
            Self::Nothing => None,
            Self::Parts(parts) => Some((0..output.parts.len()).filter(|&place| parts.contains(&output.parts[place])).collect()),
            Self::Whole => Some((0..output.parts.len()).collect()),
        }
    }
}
