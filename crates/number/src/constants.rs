//! Constants of one machine, and of several side by side.

use crate::Real;

/// Constants written for one machine that can be gathered from one machine per lane.
///
/// Derived by [`constants!`](crate::constants) for structs and by [`variants!`](crate::variants) for enums.
pub trait Gather<R: Real> {
    /// The same constants over `R`.
    type Out;
    /// Lane `i` of the result is `machine(i)`.
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> Self::Out
    where
        Self: 'a;
}

impl<R: Real> Gather<R> for f64 {
    type Out = R;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a f64) -> R
    where
        Self: 'a,
    {
        R::from_lanes(|lane| *machine(lane))
    }
}

macro_rules! shared {
    ($($Type:ty),*) => {$(
        impl<R: Real> Gather<R> for $Type {
            type Out = $Type;
            fn gather<'a>(machine: &dyn Fn(usize) -> &'a $Type) -> $Type where Self: 'a {
                let first = *machine(0);
                for lane in 1..R::LANES {
                    assert!(*machine(lane) == first, "lanes share counts and switches");
                }
                first
            }
        }
    )*};
}
shared!(usize, bool);

impl<R: Real> Gather<R> for crate::Vec2<f64> {
    type Out = crate::Vec2<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> crate::Vec2<R>
    where
        Self: 'a,
    {
        crate::Vec2::new(
            R::from_lanes(|lane| machine(lane).x),
            R::from_lanes(|lane| machine(lane).y),
        )
    }
}

impl<R: Real, T: Gather<R>> Gather<R> for Option<T> {
    type Out = Option<T::Out>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> Option<T::Out>
    where
        Self: 'a,
    {
        machine(0).as_ref().map(|_| {
            T::gather(&|lane| machine(lane).as_ref().expect("lanes share what is present"))
        })
    }
}

/// Declares a struct of constants over a number `R` and its [`Gather`].
///
/// ```
/// number::constants! {
///     /// A spring with a damper.
///     pub struct Spring {
///         /// Stiffness, N/m.
///         stiffness: R,
///         /// Damping, N s/m.
///         damping: R,
///     }
/// }
/// let soft = Spring { stiffness: 1.0, damping: 0.1 };
/// let one: Spring<number::Dual<2>> = number::Gather::gather(&|_lane| &soft);
/// assert_eq!(one.stiffness.value, 1.0);
/// ```
#[macro_export]
macro_rules! constants {
    (
        $(#[$meta:meta])*
        pub struct $Name:ident { $( $(#[$field_meta:meta])* $field:ident : $($Type:tt)::+ $(<$Arg:ident>)? ),* $(,)? }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $Name<R> { $( $(#[$field_meta])* pub $field: $($Type)::+ $(<$Arg>)? ),* }

        impl<R: $crate::Real> $crate::Gather<R> for $Name<f64> {
            type Out = $Name<R>;
            fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> $Name<R> where Self: 'a {
                $Name { $( $field: $crate::Gather::<R>::gather(&|lane| &machine(lane).$field) ),* }
            }
        }
    };
}

/// [`Gather`] of an enum of constants, each variant of which holds one value or, named first, none: all lanes share the variant.
#[macro_export]
macro_rules! variants {
    ($Name:ident, $what:literal: $($Empty:ident)?; $($Variant:ident),+) => {
        impl<R: $crate::Real> $crate::Gather<R> for $Name<f64> {
            type Out = $Name<R>;
            fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> $Name<R> where Self: 'a {
                match machine(0) {
                    $($Name::$Empty => $Name::$Empty,)?
                    $($Name::$Variant(_) => $Name::$Variant($crate::Gather::<R>::gather(&|lane| match machine(lane) {
                        $Name::$Variant(own) => own,
                        _ => panic!(concat!("lanes share the ", $what)),
                    }))),+
                }
            }
        }
    };
}
