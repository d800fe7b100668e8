//! Critical speed of cable-driven parallel robots.
