//! What travels on links: any shared value, with its type's plain name and its size.

use std::any::{Any, TypeId};
use std::sync::Arc;

/// A value on a port: shared, of any type.
#[derive(Clone)]
pub struct Value {
    any: Arc<dyn Any + Send + Sync>,
    type_name: Arc<str>,
    bytes: usize,
}

impl Value {
    /// Wraps a shared value; its plain name and size are the registry's to give.
    pub fn new<T: Send + Sync + 'static>(value: Arc<T>) -> Self {
        Self { any: value, type_name: std::any::type_name::<T>().into(), bytes: 0 }
    }
    /// The value as a `T`, if it is one.
    pub fn downcast<T: Send + Sync + 'static>(&self) -> Option<Arc<T>> {
        Arc::downcast(Arc::clone(&self.any)).ok()
    }
    /// The value as a `T`, if it is one, without sharing it.
    pub fn downcast_ref<T: 'static>(&self) -> Option<&T> {
        self.any.downcast_ref()
    }
    /// Plain name of its type.
    pub fn type_name(&self) -> &str {
        &self.type_name
    }
    /// Its size in bytes, as the registered function counts it.
    pub fn bytes(&self) -> usize {
        self.bytes
    }
    /// Which type it is.
    pub fn type_id(&self) -> TypeId {
        (*self.any).type_id()
    }

    /// Where the shared value is: the same for clones, and for no other value as long as one of them is there.
    pub(crate) fn address(&self) -> usize {
        Arc::as_ptr(&self.any).cast::<()>() as usize
    }
    pub(crate) fn any(&self) -> &(dyn Any + Send + Sync) {
        &*self.any
    }
    pub(crate) fn measured(mut self, ty: &TypeEntry) -> Self {
        self.bytes = (ty.bytes)(&*self.any);
        self.type_name = Arc::clone(&ty.name);
        self
    }
}

impl std::fmt::Debug for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Value({}, {} bytes)", self.type_name, self.bytes)
    }
}

/// Counts the bytes of a value of one type.
type Measure = Box<dyn Fn(&(dyn Any + Send + Sync)) -> usize + Send + Sync>;

/// What the registry knows of a type.
pub(crate) struct TypeEntry {
    pub(crate) name: Arc<str>,
    pub(crate) bytes: Measure,
}

impl TypeEntry {
    pub(crate) fn new<T: 'static>(name: &str, bytes: fn(&T) -> usize) -> Self {
        Self { name: name.into(), bytes: Box::new(move |any| any.downcast_ref::<T>().map_or(0, bytes)) }
    }
}
