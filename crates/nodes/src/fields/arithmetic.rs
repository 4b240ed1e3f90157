//! Calculating with fields.

use std::sync::Arc;

use pelage_field::{FieldError, ScalarField};
use pelage_graph::{Context, Evaluate, Node, NodeError, Param};

/// What is done with two numbers, a and b.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum Operation {
    /// a + b.
    Add,
    /// a − b.
    Subtract,
    /// a times b.
    Multiply,
    /// a over b; b must not be 0 anywhere.
    Divide,
    /// The lesser of the two.
    Least,
    /// The greater of the two.
    Greatest,
    /// How far they are apart.
    Difference,
    /// a to the power b; a must not be negative anywhere, nor 0 where b is negative.
    Power,
    /// From a to b as the amounts go from 0 to 1.
    Mix,
}

/// Two fields, or a field and a number, calculated with at each vertex.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex.")]
pub struct FieldMath {
    /// a.
    #[input]
    pub first: Arc<ScalarField>,
    /// b; without it the number is b everywhere.
    #[input]
    pub second: Option<Arc<ScalarField>>,
    /// How much of b is mixed in, where the operation is Mix; without it the amount is the same everywhere.
    #[input]
    pub amounts: Option<Arc<ScalarField>>,
    /// What is done.
    #[param(default = Operation::Multiply)]
    pub operation: Operation,
    /// b, where no second field is linked.
    #[param(default = 1.0, range = -1000.0..=1000.0, unit = "value", effect = "as the operation says; none on cost")]
    pub number: f64,
    /// How much of b is mixed in where no amounts are linked.
    #[param(default = 0.5, range = 0.0..=1.0, unit = "fraction", effect = "0: a; 1: b")]
    pub amount: f64,
}

impl Evaluate for FieldMath {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let constant = |value: f64| ScalarField::new(vec![value as f32; self.first.values().len()]).map(Arc::new);
        let second = self.second.clone().map_or_else(|| constant(self.number), Ok)?;
        if self.operation == Operation::Mix {
            let amounts = self.amounts.clone().map_or_else(|| constant(self.amount), Ok)?;
            return Ok(mix(&self.first, &second, &amounts)?.into());
        }
        let operation = |a: f64, b: f64| match self.operation {
            Operation::Add => a + b,
            Operation::Subtract => a - b,
            Operation::Multiply | Operation::Mix => a * b,
            Operation::Divide => a / b,
            Operation::Least => a.min(b),
            Operation::Greatest => a.max(b),
            Operation::Difference => (a - b).abs(),
            Operation::Power => libm::pow(a, b),
        };
        Ok(self.first.zip(&second, |a, b| operation(a.into(), b.into()) as f32)?.into())
    }
}

/// Exact at both ends.
fn mix(a: &ScalarField, b: &ScalarField, amounts: &ScalarField) -> Result<ScalarField, FieldError> {
    a.zip_with(b, amounts, |a, b, t| {
        let t = f64::from(t).clamp(0.0, 1.0);
        ((1.0 - t) * f64::from(a) + t * f64::from(b)) as f32
    })
}
