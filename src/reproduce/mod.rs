//! Top floor, beside the command line: the tables and figures of the papers, published, ours, corrected.

pub mod published;
