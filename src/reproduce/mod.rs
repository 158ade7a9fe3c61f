//! Top floor, beside the command line: the tables and figures of the papers, published, ours, corrected.

mod figure_7_1;
pub mod published;
pub mod squares;
mod table_7_1;

pub use figure_7_1::{Figure, Panel, figure_7_1};
pub use table_7_1::{Line, Observed, Table, table_7_1};
