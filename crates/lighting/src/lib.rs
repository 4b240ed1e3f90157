//! lighting
