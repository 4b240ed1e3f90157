//! Types that a person may write as a parameter.

use std::any::{Any, TypeId};

use crate::literal::{Literal, Shape};
use crate::spec::ParamType;
use crate::value::Value;

/// A literal or a linked value that is not what the parameter takes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected {expected}, found {found}")]
pub struct ParamError {
    /// What the parameter takes.
    pub expected: String,
    /// What was given.
    pub found: String,
}

impl ParamError {
    /// For the type `P`, given `found`.
    pub fn of<P: Param>(found: &Literal) -> Self {
        Self { expected: P::param_type().to_string(), found: found.describe() }
    }
}

/// A type that a person may write as a parameter. For enums and structs of one's own, `#[derive(Param)]`.
pub trait Param: Clone + Send + Sync + 'static {
    /// What may be written.
    fn param_type() -> ParamType;

    /// The value of a literal.
    ///
    /// # Errors
    /// If the literal is of another type; ranges are the specification's business and are not looked at.
    fn from_literal(literal: &Literal) -> Result<Self, ParamError>;

    /// How this value is written.
    fn to_literal(&self) -> Literal;

    /// The value of a linked output: the same type, or for a number another that converts without loss.
    ///
    /// # Errors
    /// If it is of another type, or does not convert.
    fn from_value(value: &Value) -> Result<Self, ParamError> {
        value
            .downcast_ref::<Self>()
            .cloned()
            .ok_or_else(|| ParamError { expected: Self::param_type().to_string(), found: value.type_name().to_owned() })
    }

    /// Types of output that [`from_value`](Self::from_value) takes.
    fn link_types() -> Vec<TypeId> {
        vec![TypeId::of::<Self>()]
    }
}

impl Param for bool {
    fn param_type() -> ParamType {
        ParamType::Bool
    }
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        match literal.shape {
            Shape::Bool(value) => Ok(value),
            _ => Err(ParamError::of::<Self>(literal)),
        }
    }
    fn to_literal(&self) -> Literal {
        (*self).into()
    }
}

/// A linked number as the literal it would be written as.
fn number_literal(value: &Value) -> Option<Literal> {
    let any: &dyn Any = value.any();
    None.or_else(|| any.downcast_ref::<f64>().map(Param::to_literal))
        .or_else(|| any.downcast_ref::<f32>().map(|&value| f64::from(value).into()))
        .or_else(|| any.downcast_ref::<i32>().map(Param::to_literal))
        .or_else(|| any.downcast_ref::<i64>().map(Param::to_literal))
        .or_else(|| any.downcast_ref::<u32>().map(Param::to_literal))
        .or_else(|| any.downcast_ref::<u64>().map(Param::to_literal))
}

/// Converts a linked number, refusing what would lose any of it.
fn linked_number<P: Param + PartialEq>(value: &Value) -> Result<P, ParamError> {
    let literal =
        number_literal(value).ok_or_else(|| ParamError { expected: P::param_type().to_string(), found: value.type_name().to_owned() })?;
    P::from_literal(&literal)
}

macro_rules! integer_param {
    ($($integer:ty),*) => {$(
        impl Param for $integer {
            fn param_type() -> ParamType {
                ParamType::Integer { min: i128::from(<$integer>::MIN), max: i128::from(<$integer>::MAX) }
            }
            fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
                match literal.shape {
                    Shape::Integer(value) => value.try_into().map_err(|_| ParamError::of::<Self>(literal)),
                    _ => Err(ParamError::of::<Self>(literal)),
                }
            }
            fn to_literal(&self) -> Literal {
                (*self).into()
            }
            fn from_value(value: &Value) -> Result<Self, ParamError> {
                linked_number(value)
            }
            /// Whole numbers of any width; the value is checked when it comes.
            fn link_types() -> Vec<TypeId> {
                vec![TypeId::of::<i32>(), TypeId::of::<i64>(), TypeId::of::<u32>(), TypeId::of::<u64>()]
            }
        }
    )*};
}
integer_param!(i32, i64, u32, u64);

/// Numbers of any kind may be linked to a floating-point parameter.
fn number_types() -> Vec<TypeId> {
    vec![TypeId::of::<f64>(), TypeId::of::<f32>(), TypeId::of::<i32>(), TypeId::of::<i64>(), TypeId::of::<u32>(), TypeId::of::<u64>()]
}

impl Param for f64 {
    fn param_type() -> ParamType {
        ParamType::Number { bits: 64 }
    }
    /// A whole number beyond 2⁵³ is refused unless it is exact as an `f64`.
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        match literal.shape {
            Shape::Number(value) => Ok(value),
            Shape::Integer(value) if (value as f64) as i128 == value => Ok(value as f64),
            _ => Err(ParamError::of::<Self>(literal)),
        }
    }
    fn to_literal(&self) -> Literal {
        (*self).into()
    }
    fn from_value(value: &Value) -> Result<Self, ParamError> {
        linked_number(value)
    }
    fn link_types() -> Vec<TypeId> {
        number_types()
    }
}

impl Param for f32 {
    fn param_type() -> ParamType {
        ParamType::Number { bits: 32 }
    }
    /// The nearest `f32`, as everywhere that a decimal is read into one.
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        f64::from_literal(literal).map(|value| value as f32)
    }
    /// The shortest decimal that reads back as this `f32`: 0.1, not 0.10000000149.
    fn to_literal(&self) -> Literal {
        self.to_string().parse().unwrap_or(f64::from(*self)).into()
    }
    fn from_value(value: &Value) -> Result<Self, ParamError> {
        linked_number(value)
    }
    fn link_types() -> Vec<TypeId> {
        number_types()
    }
}

impl Param for String {
    fn param_type() -> ParamType {
        ParamType::Text
    }
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        match &literal.shape {
            Shape::Text(text) => Ok(text.clone()),
            _ => Err(ParamError::of::<Self>(literal)),
        }
    }
    fn to_literal(&self) -> Literal {
        self.as_str().into()
    }
}

impl<P: Param, const N: usize> Param for [P; N] {
    fn param_type() -> ParamType {
        ParamType::Tuple(vec![P::param_type(); N])
    }
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        let Shape::Tuple(items) = &literal.shape else { return Err(ParamError::of::<Self>(literal)) };
        let items: Vec<P> = items.iter().map(P::from_literal).collect::<Result<_, _>>()?;
        items.try_into().map_err(|_| ParamError::of::<Self>(literal))
    }
    fn to_literal(&self) -> Literal {
        Shape::Tuple(self.iter().map(Param::to_literal).collect()).into()
    }
}

macro_rules! tuple_param {
    ($(($($name:ident $index:tt),*)),*) => {$(
        impl<$($name: Param),*> Param for ($($name,)*) {
            fn param_type() -> ParamType {
                ParamType::Tuple(vec![$($name::param_type()),*])
            }
            fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
                const LENGTH: usize = [$($index),*].len();
                match &literal.shape {
                    Shape::Tuple(items) if items.len() == LENGTH => Ok(($($name::from_literal(&items[$index])?,)*)),
                    _ => Err(ParamError::of::<Self>(literal)),
                }
            }
            fn to_literal(&self) -> Literal {
                Shape::Tuple(vec![$(self.$index.to_literal()),*]).into()
            }
        }
    )*};
}
tuple_param!((A 0, B 1), (A 0, B 1, C 2), (A 0, B 1, C 2, D 3));

impl<P: Param> Param for Vec<P> {
    fn param_type() -> ParamType {
        ParamType::List(Box::new(P::param_type()))
    }
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        match &literal.shape {
            Shape::List(items) => items.iter().map(P::from_literal).collect(),
            _ => Err(ParamError::of::<Self>(literal)),
        }
    }
    fn to_literal(&self) -> Literal {
        Shape::List(self.iter().map(Param::to_literal).collect()).into()
    }
}

impl<P: Param> Param for Option<P> {
    fn param_type() -> ParamType {
        ParamType::Optional(Box::new(P::param_type()))
    }
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        match &literal.shape {
            Shape::Absent => Ok(None),
            Shape::Present(inner) => P::from_literal(inner).map(Some),
            _ => P::from_literal(literal).map(Some),
        }
    }
    fn to_literal(&self) -> Literal {
        match self {
            Some(value) => Shape::Present(Box::new(value.to_literal())).into(),
            None => Shape::Absent.into(),
        }
    }
    fn from_value(value: &Value) -> Result<Self, ParamError> {
        P::from_value(value).map(Some)
    }
    fn link_types() -> Vec<TypeId> {
        P::link_types()
    }
}
