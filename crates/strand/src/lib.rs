//! strand
