//! How the pool deals with faults.
