//! Things that nodes share and that are made when first asked for, such as a graphics device.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::node::NodeError;

type Shared = Arc<dyn Any + Send + Sync>;

struct Slot {
    make: Box<dyn Fn() -> Result<Shared, NodeError> + Send + Sync>,
    made: Mutex<Option<Shared>>,
}

/// Shared things by type, each made at most once, when first asked for.
#[derive(Default)]
pub struct Resources {
    slots: HashMap<TypeId, Slot>,
}

/// Asked for a resource that the program does not provide.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("this program provides no {0}")]
pub struct NoSuchResource(
    /// Rust name of the type.
    pub String,
);

impl Resources {
    pub(crate) fn provide<R, E>(&mut self, make: impl Fn() -> Result<R, E> + Send + Sync + 'static)
    where
        R: Send + Sync + 'static,
        E: Into<NodeError>,
    {
        let make = move || make().map(|made| Arc::new(made) as Shared).map_err(Into::into);
        self.slots.insert(TypeId::of::<R>(), Slot { make: Box::new(make), made: Mutex::new(None) });
    }

    /// The `R`, made if it was not yet. Who asks meanwhile waits. After an error the next who asks tries again.
    ///
    /// # Errors
    /// If the program provides none, or the error of making it, as it is.
    pub fn get<R: Send + Sync + 'static>(&self) -> Result<Arc<R>, NodeError> {
        let missing = || NodeError::from(NoSuchResource(std::any::type_name::<R>().to_owned()));
        let slot = self.slots.get(&TypeId::of::<R>()).ok_or_else(missing)?;
        let mut made = slot.made.lock().unwrap_or_else(PoisonError::into_inner);
        let shared = match &*made {
            Some(shared) => Arc::clone(shared),
            None => Arc::clone(made.insert((slot.make)()?)),
        };
        shared.downcast::<R>().map_err(|_| missing())
    }
}
