# Installation: filled in below by the install rules of the package.
