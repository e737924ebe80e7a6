# SPDX-License-Identifier: GPL-3.0-or-later
# Hyperex in a container, built by the commands that an empty Debian 12 takes: `make deb`, then the packages.
#   docker build -t hyperex .
#   docker run --rm -v "$PWD:/work" hyperex run me.toml --out out/me
# The studio is bound to the loopback address, so it takes the host's network:
#   docker run --rm -v "$PWD:/work" --network host hyperex studio --no-browser me.toml
FROM debian:12-slim AS build
RUN apt-get update && apt-get install --yes --no-install-recommends git make sudo ca-certificates
COPY . /hyperex
WORKDIR /hyperex
RUN make deb

FROM debian:12-slim
COPY --from=build /hyperex/build/deb/*.deb /packages/
RUN apt-get update \
  && apt-get install --yes --no-install-recommends /packages/*.deb \
  && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["hyperex"]
CMD ["--help"]
