# docker build -t seisblock . && docker run --rm -v "$PWD:/data" -w /data seisblock jump record.csv
FROM python:3.11-slim
COPY . /src
RUN pip install --no-cache-dir /src && rm -r /src
ENV SEISBLOCK_CACHE_DIR=/var/cache/seisblock
# compiles the kernels of the main job into the image
RUN mkdir -p "$SEISBLOCK_CACHE_DIR" && seisblock jump --quiet > /dev/null && chmod -R a+rwX "$SEISBLOCK_CACHE_DIR"
ENTRYPOINT ["seisblock"]
CMD ["--help"]
