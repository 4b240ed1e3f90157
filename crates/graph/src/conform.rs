//! A written value against what its parameter takes: every fault in it, and the value in canonical form.

use crate::fault::{FaultKind, nearest};
use crate::literal::{Literal, Name, Place, Shape};
use crate::param::Param;
use crate::spec::{ChoiceSpec, Limits, ParamSpec, ParamType, RecordSpec};

/// A fault within a value.
#[derive(Clone, Debug)]
pub(crate) struct Misfit {
    pub(crate) place: Option<Place>,
    /// Fields on the way from the parameter, `.radius`.
    pub(crate) path: String,
    pub(crate) kind: FaultKind,
}

/// Checks `literal` against `spec`.
///
/// What comes back is canonical, so that equal meanings have equal keys: numbers of a floating-point parameter are
/// [`Shape::Number`] (and never −0), whole ones [`Shape::Integer`], options explicit, variants and records complete with
/// their defaults in the order of the specification. It is meaningful only if no misfit was added.
pub(crate) fn conform(spec: &ParamSpec, literal: &Literal, misfits: &mut Vec<Misfit>) -> Literal {
    Check { range: spec.range, unit: spec.unit.as_deref(), path: String::new(), misfits }.value(&spec.ty, literal)
}

struct Check<'c> {
    range: Option<Limits>,
    unit: Option<&'c str>,
    path: String,
    misfits: &'c mut Vec<Misfit>,
}

impl Check<'_> {
    fn fault(&mut self, place: Option<Place>, kind: FaultKind) {
        self.misfits.push(Misfit { place, path: self.path.clone(), kind });
    }

    fn wrong(&mut self, ty: &ParamType, literal: &Literal) -> Literal {
        self.fault(literal.place, FaultKind::WrongType { expected: ty.to_string(), found: literal.describe() });
        literal.clone()
    }

    fn value(&mut self, ty: &ParamType, literal: &Literal) -> Literal {
        let shape = match (ty, &literal.shape) {
            (ParamType::Bool, Shape::Bool(_)) | (ParamType::Text | ParamType::File, Shape::Text(_)) => literal.shape.clone(),
            (ParamType::Integer { min, max }, Shape::Integer(value)) => {
                if value < min || value > max {
                    let range = self.range.map_or_else(|| format!("{min} to {max}"), |range| range.to_string());
                    self.out_of_range(literal, range);
                } else {
                    self.in_range(literal, *value as f64);
                }
                literal.shape.clone()
            }
            (ParamType::Number { bits }, Shape::Number(_) | Shape::Integer(_)) => self.number(ty, *bits, literal),
            (ParamType::Colour, Shape::Tuple(items)) if items.len() == 3 => {
                let range = Some(Limits { min: Some(0.0), max: Some(1.0), max_excluded: false });
                let mut check = Check { range, unit: None, path: self.path.clone(), misfits: &mut *self.misfits };
                Shape::Tuple(items.iter().map(|item| check.value(&ParamType::Number { bits: 64 }, item)).collect())
            }
            (ParamType::Tuple(types), Shape::Tuple(items)) if types.len() == items.len() => {
                Shape::Tuple(types.iter().zip(items).map(|(ty, item)| self.value(ty, item)).collect())
            }
            (ParamType::List(ty), Shape::List(items)) => Shape::List(items.iter().map(|item| self.value(ty, item)).collect()),
            (ParamType::Optional(_), Shape::Absent) => Shape::Absent,
            (ParamType::Optional(ty), Shape::Present(inner)) => Shape::Present(Box::new(self.value(ty, inner))),
            (ParamType::Optional(ty), _) => Shape::Present(Box::new(self.value(ty, literal))),
            (ParamType::Choice(choice), _) => return self.choice(ty, choice, literal),
            (ParamType::Record(record), Shape::Record(name, fields)) if name.as_ref().is_none_or(|name| *name == record.name) => {
                Shape::Record(None, self.fields(record, fields, literal.place))
            }
            (ParamType::Record(record), Shape::Tuple(items)) if items.is_empty() => {
                Shape::Record(None, self.fields(record, &[], literal.place))
            }
            _ => return self.wrong(ty, literal),
        };
        Literal { shape, place: literal.place }
    }

    fn number(&mut self, ty: &ParamType, bits: u8, literal: &Literal) -> Shape {
        let Ok(value) = f64::from_literal(literal) else { return self.wrong(ty, literal).shape };
        let narrow = value as f32;
        if !value.is_finite() || bits == 32 && !narrow.is_finite() {
            self.fault(literal.place, FaultKind::NotFinite { value: literal.to_string() });
        } else {
            self.in_range(literal, value);
        }
        // Adding zero turns −0 into 0 and changes nothing else.
        let canonical = if bits == 32 { narrow.to_literal().shape } else { Shape::Number(value) };
        if let Shape::Number(value) = canonical { Shape::Number(value + 0.0) } else { canonical }
    }

    fn in_range(&mut self, literal: &Literal, value: f64) {
        if let Some(range) = self.range.filter(|range| !range.contains(value)) {
            self.out_of_range(literal, range.to_string());
        }
    }

    fn out_of_range(&mut self, literal: &Literal, range: String) {
        let unit = self.unit.map(str::to_owned);
        self.fault(literal.place, FaultKind::OutOfRange { value: literal.to_string(), range, unit });
    }

    fn choice(&mut self, ty: &ParamType, choice: &ChoiceSpec, literal: &Literal) -> Literal {
        let (name, fields): (&str, &[(Name, Literal)]) = match &literal.shape {
            Shape::Word(name) => (name, &[]),
            Shape::Call(name, items) if items.is_empty() => (name, &[]),
            Shape::Record(Some(name), fields) => (name, fields),
            _ => return self.wrong(ty, literal),
        };
        let Some(variant) = choice.variants.iter().find(|variant| variant.name == name) else {
            let known = || choice.variants.iter().map(|variant| variant.name.as_str());
            self.fault(
                literal.place,
                FaultKind::UnknownVariant {
                    choice: choice.name.clone(),
                    variant: name.to_owned(),
                    nearest: nearest(name, known()),
                    known: known().map(str::to_owned).collect(),
                },
            );
            return literal.clone();
        };
        Literal { shape: Shape::Record(Some(name.to_owned()), self.fields(variant, fields, literal.place)), place: literal.place }
    }

    /// All fields of a variant or record, in its order.
    fn fields(&mut self, record: &RecordSpec, given: &[(Name, Literal)], place: Option<Place>) -> Vec<(Name, Literal)> {
        let find = |name: &Name| record.fields.iter().position(|field| field.name == name.text || field.was.contains(&name.text));
        for (index, (name, _)) in given.iter().enumerate() {
            match find(name) {
                None => {
                    self.fault(name.place, unknown_field(&record.name, &name.text, record.fields.iter().map(|field| field.name.as_str())));
                }
                field if given[..index].iter().any(|(earlier, _)| find(earlier) == field) => {
                    self.fault(name.place, FaultKind::DuplicateField { field: name.text.clone() });
                }
                Some(_) => {}
            }
        }
        record
            .fields
            .iter()
            .filter_map(|field| {
                let written =
                    given.iter().find(|(name, _)| name.text == field.name || field.was.contains(&name.text)).map(|(_, value)| value);
                let Some(value) = written.or(field.default.as_ref()) else {
                    self.fault(place, FaultKind::Missing { field: field.name.clone(), expected: field.ty.to_string() });
                    return None;
                };
                let path = format!("{}.{}", self.path, field.name);
                let mut check = Check { range: field.range, unit: field.unit.as_deref(), path, misfits: &mut *self.misfits };
                Some((Name { text: field.name.clone(), place: None }, check.value(&field.ty, value)))
            })
            .collect()
    }
}

/// The fault of naming a field that `owner` does not have.
pub(crate) fn unknown_field<'k>(owner: &str, field: &str, known: impl Iterator<Item = &'k str> + Clone) -> FaultKind {
    FaultKind::UnknownField {
        owner: owner.to_owned(),
        field: field.to_owned(),
        nearest: nearest(field, known.clone()),
        known: known.map(str::to_owned).collect(),
    }
}
